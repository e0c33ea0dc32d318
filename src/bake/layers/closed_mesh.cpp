#include "bake/layers/closed_mesh.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>
#include <unordered_map>

#include "quadrel/error.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "quadrel/scene/shapes.hpp"

namespace quadrel {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// -0 and 0 are one place.
std::tuple<float, float, float> place(const glm::vec3& p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

std::string point(const glm::vec3& p) { return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z); }

/// How much more often an edge is run along from its lesser corner than back.
std::map<Edge, int> unmatched_edges(const WeldedMesh& mesh) {
    std::map<Edge, int> edges;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
    return edges;
}

/// The shapes that scenes have by name and that are closed, at their own size.
const std::map<std::string, Mesh (*)()>& closed_shapes() {
    static const std::map<std::string, Mesh (*)()> shapes{
        {"cube", [] { return make_cube(); }},
        {"icosahedron", [] { return make_icosahedron(); }},
        {"sphere", [] { return make_sphere(); }},
        {"torus", [] { return make_torus(); }}};
    return shapes;
}

}  // namespace

WeldedMesh weld_closed(const Mesh& mesh) {
    WeldedMesh welded;
    std::map<std::tuple<float, float, float>, std::uint32_t> known;
    std::vector<std::uint32_t> corner_of;
    for (const glm::vec3& position : mesh.positions) {
        const auto next = static_cast<std::uint32_t>(welded.positions.size());
        const auto [entry, is_new] = known.try_emplace(place(position), next);
        if (is_new) welded.positions.push_back(position);
        corner_of.push_back(entry->second);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::array corners{corner_of[a], corner_of[b], corner_of[c]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        welded.triangles.push_back(corners);
    }
    const auto open = unmatched_edges(welded);
    if (!open.empty()) {
        const auto& [edge, count] = *open.begin();
        throw InputError(
            mesh.name, "",
            fmt::format("{} open edge{}, one from {} to {}", open.size(),
                        open.size() == 1 ? "" : "s", point(welded.positions[edge.first]),
                        point(welded.positions[edge.second])),
            "a closed mesh: each edge of one triangle is another's, run along the other way");
    }
    if (welded.triangles.empty()) throw InputError(mesh.name, "", "no triangle", "a closed mesh");
    return welded;
}

bool is_closed_shape(const std::string& name) { return closed_shapes().count(name) > 0; }

Mesh closed_mesh(const std::string& shape_or_file) {
    const auto shape = closed_shapes().find(shape_or_file);
    Mesh mesh = shape != closed_shapes().end() ? shape->second() : load_mesh(shape_or_file);
    mesh.name = shape_or_file;
    return mesh;
}

}  // namespace quadrel
