// Where two triangles meet at an edge and have vertices of their own there.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/displace/edges.hpp"

namespace quadrel::displacement {

/// The edge of the triangle that goes from its `from` to its `to`, and of the one that comes back.
struct Seam {
    std::uint32_t forth, back;
};

/// Edges of different vertices at the same positions, at each of which exactly two triangles lie,
/// of one orientation.
std::vector<Seam> find_seams(const Mesh& mesh, const Edges& edges);

/// Most triangles that walls at a seam need, their share of the corners included.
std::uint64_t most_wall_triangles(const Seam& seam, const Edges& edges);

/// The walls of all seams as triples of vertices: of the mesh, then of cuts. Together with the
/// facets they are closed where the mesh is; where both sides of a seam agree they have no area.
std::vector<std::array<std::uint32_t, 3>> wall_triangles(const std::vector<Seam>& seams,
                                                         const Edges& edges,
                                                         std::size_t mesh_vertices);

}  // namespace quadrel::displacement
