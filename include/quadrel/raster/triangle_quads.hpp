// One triangle alone: clipped, snapped, and as the quads that it covers.
#pragma once

#include <vector>

#include "quadrel/raster/assemble.hpp"
#include "quadrel/raster/coverage.hpp"

namespace quadrel {

/// A piece of the triangle, and every quad that it covers a pixel of: by row, from left to right.
struct TriangleQuads {
    AssembledTriangle piece;
    std::vector<QuadCoverage> quads;
};

/// The pieces of the triangle of three clip-space positions that are drawn; one of them if nothing
/// is clipped, none if it is culled or outside. One sample per pixel; no depth test beyond near and
/// far planes. Every covered pixel belongs to one piece.
std::vector<TriangleQuads> triangle_quads(const std::array<glm::vec4, 3>& clip,
                                          const RasterState& state);

}  // namespace quadrel
