// Meshes made of a rectangular grid of parameters.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// A vertex in double, before it is rounded.
struct GridVertex {
    glm::dvec3 position, normal;
    glm::dvec2 uv;
};

inline void add_vertex(Mesh& mesh, const GridVertex& vertex) {
    mesh.positions.emplace_back(vertex.position);
    mesh.normals.emplace_back(vertex.normal);
    mesh.uvs.emplace_back(vertex.uv);
}

/// Appends a grid of columns x rows cells; vertex(column, row) gives (columns + 1) * (rows + 1)
/// vertices. Triangles are counter-clockwise where columns run to the right and rows upwards;
/// those whose corners coincide (poles) are left out.
template <class MakeVertex>
void append_grid(Mesh& mesh, int columns, int rows, const MakeVertex& vertex) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) add_vertex(mesh, vertex(column, row));
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& p = mesh.positions;
        if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.push_back({a, b, c});
    };
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column + 1 < stride; ++column) {
            const std::uint32_t corner = base + row * stride + column;
            add(corner, corner + 1, corner + stride + 1);
            add(corner, corner + stride + 1, corner + stride);
        }
    }
}

}  // namespace quadrel
