// The mesh that is displaced, made ready.
#pragma once

#include <vector>

#include "scene/displace/edges.hpp"

namespace quadrel::displacement {

/// A point of the mesh with what displaces it.
struct Vertex {
    glm::dvec3 point{0}, normal{0};
    double offset = 0;  ///< along `normal`
    glm::dvec2 uv{0};   ///< the mesh's own

    glm::dvec3 displaced() const { return point + normal * offset; }
};

struct Base {
    Base(const Mesh& given, const Displacement& displacement);

    /// Of a height.
    double offset(double height) const { return (height - seat) * depth; }

    Mesh mesh;  ///< with unit normals
    double depth, seat;
    std::vector<Place> places;  ///< of its vertices
};

/// The mesh with unit vertex normals; each triangle with corners of its own if it has none.
Mesh with_unit_normals(const Mesh& mesh);

/// uv as the height map is read at.
glm::vec2 mapped_uv(const Displacement& displacement, const glm::vec2& uv);

/// The mesh's vertices, then those of all cuts of its edges.
std::vector<Vertex> shared_vertices(const Base& base, const Edges& edges, const Lattice& lattice);

}  // namespace quadrel::displacement
