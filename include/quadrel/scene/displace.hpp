// Relief as geometry: a mesh whose vertices stand where a height map puts them. What every
// algorithm that only looks so can be held against.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>

#include "quadrel/scene/mesh.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// Which diagonal cuts a cell in two triangles: (0, 0) to (1, 1), (1, 0) to (0, 1), or the one
/// whose ends differ less in height, the main one of two equal ones.
enum class CellSplit : std::int32_t { main, anti, min };

/// The height field to displace by.
struct Displacement {
    /// Level 0, channel 0 and the wrap modes of it are read; must outlive its use. Finite.
    const SampledTexture* heights = nullptr;
    double depth = 0.05;  ///< D >= 0: from height 0 to height 1, in the mesh's unit of length
    double seat = 1;      ///< in [0, 1]: the height that stays where the mesh is
    /// 0: cells between the centres of texels. Else as many cells along u and along v of a tile, in
    /// [1, max_displacement_cells], whose corners take bilinear heights.
    int cells = 0;
    CellSplit split = CellSplit::main;
    glm::mat4 texture_matrix{1.0f};  ///< from the mesh's uv to the height map's
};

inline constexpr int max_displacement_cells = 65536;
inline constexpr std::uint64_t max_displaced_triangles = 20'000'000;
/// Cells are counted up to here, in both directions from the origin of texture space.
inline constexpr double max_displacement_reach = 0x1p30;

/// What displacing comes to, before it is done.
struct DisplacedSize {
    /// Cells from the origin of texture space to the mesh's farthest corner. Beyond
    /// max_displacement_reach, or NaN, nothing else is counted.
    double reach = 0;
    /// Exact but for seams, of which it is the most that they may need; far beyond
    /// max_displaced_triangles an estimate.
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;  ///< likewise
    std::uint64_t bytes()
        const;  ///< of the displaced mesh and of what the vertex stage makes of it
};

/// The mesh has uv.
DisplacedSize displaced_size(const Mesh& mesh, const Displacement& displacement);

/// `mesh` with each triangle cut along the borders and the diagonals of all cells that it lies in,
/// and each vertex at
///
///     P + (h(u, v) - seat) D N,
///
/// where P, u, v and N are linear in each triangle, N between unit vertex normals (the triangles'
/// where the mesh has none): the surface that the shell between the meshes of P - seat D N and
/// P + (1 - seat) D N holds at height h. Every facet lies in half a cell, in which h is linear.
///
/// Watertight: neighbours share the vertices of their common edge; cuts are found in integers
/// (2^-20 of a cell), so that none is lost or found twice. Where two triangles at one edge disagree
/// about its heights or normals (seams of uv, creases), walls join their borders, and the corners
/// of walls: what was closed stays closed. Edges of three triangles and more stay as they come.
///
/// Vertex normals are the means of the facets around, by area, each turned so that equal heights
/// give the mesh's own normal: D = 0 is the mesh. The result has uv and no tangents.
///
/// Throws std::invalid_argument for a mesh without uv, std::length_error beyond the reach or the
/// triangles above (displaced_size tells).
Mesh displaced(const Mesh& mesh, const Displacement& displacement);

}  // namespace quadrel
