// The displaced mesh as it is put together: vertices, facets, walls, and normals that are means of
// the facets around.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "quadrel/num/functions.hpp"
#include "scene/displace/base.hpp"

namespace quadrel::displacement {

/// Vertices of the mesh that comes out, with their displaced positions.
class Facets {
  public:
    Facets(std::vector<Vertex> shared, std::uint64_t vertices, std::uint64_t triangles)
        : shared_(std::move(shared)), sums_(shared_.size(), glm::dvec3(0)) {
        mesh_.positions.reserve(vertices);
        mesh_.uvs.reserve(vertices);
        mesh_.normals.reserve(vertices);
        mesh_.triangles.reserve(triangles);
        for (const Vertex& v : shared_) add(v);
        mesh_.normals.resize(shared_.size());
    }

    /// Begins a triangle, whose own vertices follow those that there are; the number of the first.
    std::uint32_t begin() {
        return first_own_ = static_cast<std::uint32_t>(mesh_.positions.size());
    }
    void add_own(const Vertex& v) {
        own_.push_back(v);
        own_sums_.emplace_back(0);
        add(v);
    }
    /// Its vertices are complete, and so are their normals.
    void end() {
        for (std::size_t v = 0; v < own_.size(); ++v)
            mesh_.normals.push_back(mean_normal(own_sums_[v], own_[v]));
        own_.clear();
        own_sums_.clear();
    }

    /// A facet of different vertices. None where two of them coincide.
    void add_facet(std::array<std::uint32_t, 3> index) {
        if (coincide(index)) return;
        mesh_.triangles.push_back(index);
        const Vertex *a = &vertex(index[0]), *b = &vertex(index[1]), *c = &vertex(index[2]);
        const EdgeVector first(*a, *b), second(*a, *c);
        for (const std::uint32_t v : index) {
            const glm::dvec3 share = facet_normal(first, second, vertex(v).normal);
            (v < shared_.size() ? sums_[v] : own_sums_[v - first_own_]) += share;
        }
    }

    /// A wall has vertices and a normal of its own; one without area, beside which nothing stands
    /// apart, its vertices' normals.
    void add_wall(const std::array<std::uint32_t, 3>& index) {
        if (coincide(index)) return;
        const glm::dvec3 p = vertex(index[0]).displaced();
        const glm::dvec3 a = vertex(index[1]).displaced() - p, b = vertex(index[2]).displaced() - p;
        const glm::dvec3 n = cross(a, b);
        const bool flat = length(n) <= 1e-9 * (dot(a, a) + dot(b, b));
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        for (const std::uint32_t v : index) {
            const glm::vec3 position = mesh_.positions[v];
            const glm::vec2 uv = mesh_.uvs[v];
            mesh_.positions.push_back(position);
            mesh_.uvs.push_back(uv);
            mesh_.normals.push_back(mean_normal(flat ? glm::dvec3(0) : n, vertex(v)));
        }
        mesh_.triangles.push_back({first, first + 1, first + 2});
    }

    Mesh take() {
        for (std::size_t v = 0; v < shared_.size(); ++v)
            mesh_.normals[v] = mean_normal(sums_[v], shared_[v]);
        return std::move(mesh_);
    }

    const Vertex& vertex(std::uint32_t v) const {
        return v < shared_.size() ? shared_[v] : own_[v - first_own_];
    }

  private:
    /// From one displaced vertex to another: along the mesh, and how far up.
    struct EdgeVector {
        glm::dvec3 along;
        double up;
        EdgeVector(const Vertex& a, const Vertex& b)
            : along(b.displaced() - a.displaced() -
                    (a.normal + b.normal) * (0.5 * (b.offset - a.offset))),
              up(b.offset - a.offset) {}
        glm::dvec3 seen_from(const glm::dvec3& n, double size) const {
            return along - n * dot(n, along) + n * (up * size);
        }
    };

    /// Twice the area long, and turned as the mesh's normal is from the mesh's facet.
    static glm::dvec3 facet_normal(const EdgeVector& a, const EdgeVector& b,
                                   const glm::dvec3& normal) {
        const double size = length(normal);
        if (!(size > 0)) return cross(a.along, b.along);
        const glm::dvec3 n = normal / size;
        const glm::dvec3 facet = cross(a.seen_from(n, size), b.seen_from(n, size));
        return dot(cross(a.along, b.along), n) < 0 ? -facet : facet;
    }

    static glm::vec3 mean_normal(const glm::dvec3& sum, const Vertex& v) {
        const double size = length(sum);
        if (size > 0) return glm::vec3(sum / size);
        const double own = length(v.normal);
        return glm::vec3(own > 0 ? v.normal / own : glm::dvec3(0, 0, 1));
    }

    bool coincide(const std::array<std::uint32_t, 3>& index) const {
        const auto& p = mesh_.positions;
        return p[index[0]] == p[index[1]] || p[index[1]] == p[index[2]] ||
               p[index[2]] == p[index[0]];
    }

    void add(const Vertex& v) {
        mesh_.positions.emplace_back(v.displaced());
        mesh_.uvs.emplace_back(v.uv);
    }

    Mesh mesh_;
    std::vector<Vertex> shared_, own_;
    std::vector<glm::dvec3> sums_, own_sums_;
    std::uint32_t first_own_ = 0;
};

}  // namespace quadrel::displacement
