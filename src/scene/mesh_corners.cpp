#include "scene/mesh_corners.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/tangents.hpp"

namespace quadrel {
namespace {

/// Of the triangle's counter-clockwise side; null without area.
glm::vec3 triangle_normal(const Mesh& mesh, std::size_t triangle) {
    const auto& index = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[index[0]]);
    const glm::dvec3 n =
        cross(glm::dvec3(mesh.positions[index[1]]) - a, glm::dvec3(mesh.positions[index[2]]) - a);
    const double size = length(n);
    return size > 0 ? glm::vec3(n / size) : glm::vec3(0.0f);
}

std::uint32_t copy_vertex(Mesh& mesh, std::uint32_t v) {
    const auto copy = [v](auto& list) {
        if (list.empty()) return;
        const auto element = list[v];
        list.push_back(element);
    };
    copy(mesh.positions);
    copy(mesh.normals);
    copy(mesh.uvs);
    copy(mesh.tangents);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// Gives corners of vertices that lack an element of a list one of their own.
template <class T>
class CornerFiller {
  public:
    CornerFiller(Mesh& mesh, std::vector<T> Mesh::*list, std::vector<bool> lacking)
        : mesh_(mesh), list_(list), lacking_(std::move(lacking)), given_(lacking_.size()) {}

    void give(std::size_t triangle, std::size_t corner, const T& value) {
        std::uint32_t& v = mesh_.triangles[triangle][corner];
        if (!is_open(v)) return;
        // The first one takes the vertex itself.
        if (given_[v] && (mesh_.*list_)[v] != value)
            v = copy_with(v, value);
        else
            (mesh_.*list_)[v] = value, given_[v] = true;
    }

    /// For a corner that may have anything: `value` if there is nothing yet.
    void give_if_none(std::size_t triangle, std::size_t corner, const T& value) {
        const std::uint32_t v = mesh_.triangles[triangle][corner];
        if (is_open(v) && !given_[v]) give(triangle, corner, value);
    }

  private:
    // Copies are made with their element.
    bool is_open(std::uint32_t v) const { return v < lacking_.size() && lacking_[v]; }

    std::uint32_t copy_with(std::uint32_t v, const T& value) {
        const auto latest = latest_copy_.find(v);
        if (latest != latest_copy_.end() && (mesh_.*list_)[latest->second] == value)
            return latest->second;
        const std::uint32_t copy = copy_vertex(mesh_, v);
        (mesh_.*list_)[copy] = value;
        return latest_copy_[v] = copy;
    }

    Mesh& mesh_;
    std::vector<T> Mesh::*list_;
    std::unordered_map<std::uint32_t, std::uint32_t> latest_copy_;
    std::vector<bool> lacking_, given_;
};

/// Whether a normal is none. Lengths whose squares leave float's range become 1.
bool lacks_direction(glm::vec3& n) {
    constexpr double shortest = 0x1p-20, longest = 0x1p20;
    const glm::dvec3 wide(n);
    const double size = length(wide);
    if (!(size > 0) || !std::isfinite(size)) return true;
    if (size < shortest || size > longest) n = glm::vec3(wide / size);
    return false;
}

bool all(const std::vector<bool>& list) {
    return std::find(list.begin(), list.end(), false) == list.end();
}
bool none(const std::vector<bool>& list) {
    return std::find(list.begin(), list.end(), true) == list.end();
}

}  // namespace

void settle_normals(Mesh& mesh) {
    std::vector<bool> lacking;
    for (glm::vec3& n : mesh.normals) lacking.push_back(lacks_direction(n));
    if (all(lacking)) mesh.normals.clear();
    if (mesh.normals.empty() || none(lacking)) return;
    CornerFiller filler(mesh, &Mesh::normals, std::move(lacking));
    std::vector<std::size_t> flattened;  // triangles without area
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 face = triangle_normal(mesh, t);
        if (face == glm::vec3(0.0f)) flattened.push_back(t);
        for (std::size_t c = 0; c < 3 && face != glm::vec3(0.0f); ++c) filler.give(t, c, face);
    }
    for (const std::size_t t : flattened)
        for (std::size_t c = 0; c < 3; ++c) filler.give_if_none(t, c, glm::vec3(0, 0, 1));
}

void settle_tangents(Mesh& mesh) {
    std::vector<bool> lacking;
    for (const glm::vec4& t : mesh.tangents) lacking.push_back(glm::vec3(t) == glm::vec3(0.0f));
    if (all(lacking)) mesh.tangents.clear();
    if (mesh.tangents.empty() || none(lacking)) return;
    const auto tangents = mikkt_tangents(mesh);
    CornerFiller filler(mesh, &Mesh::tangents, std::move(lacking));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec4& own = tangents[t][c];
            // A file's bitangents point against v, these along it.
            filler.give(t, c, glm::vec4(glm::vec3(own), -own.w));
        }
}

}  // namespace quadrel
