// Which samples a triangle covers, and which quads of a tile are to be shaded.
//
// A quad is the 2x2 pixels at even window coordinates of the whole frame, whatever the tile. Lanes
// are 0 (even x, even y), 1 (odd, even), 2 (even, odd), 3 (odd, odd).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quadrel/raster/setup.hpp"
#include "quadrel/raster/tile_buffer.hpp"

namespace quadrel {

/// One triangle in one quad: bit s of samples[lane] is set if sample s of that pixel is to be
/// shaded. At least one bit is set. Lanes without a bit are helper lanes.
struct QuadCoverage {
    std::int32_t x = 0, y = 0;  ///< lane 0, window coordinates, even
    std::uint32_t triangle = 0;
    std::array<std::uint16_t, 4> samples{};
    bool operator==(const QuadCoverage&) const = default;

    /// Whether a sample is to be shaded: not so while one is being put together or taken apart.
    bool is_any() const { return samples != std::array<std::uint16_t, 4>{}; }
};

/// Window coordinates of a lane's pixel.
inline int lane_x(const QuadCoverage& quad, int lane) { return quad.x + (lane & 1); }
inline int lane_y(const QuadCoverage& quad, int lane) { return quad.y + (lane >> 1); }

/// Samples of one pixel that the triangle covers, within the frame but regardless of any tile.
std::uint16_t coverage_mask(const ScreenTriangle& triangle, int x, int y, int samples);

/// False only if it covers no sample of any pixel: its bounding box holds none.
bool may_cover(const ScreenTriangle& triangle, int samples);

/// Draws the triangle: depth test and visible triangle of every sample of the tile. `index` is
/// below no_triangle; at equal depth the smaller one wins.
void rasterize(const ScreenTriangle& triangle, std::uint32_t index, TileBuffer& tile);

/// Appends each (quad, triangle) that has a visible sample in the tile, row by row, from left to
/// right, triangles of a quad by ascending index.
void collect_quads(const TileBuffer& tile, std::vector<QuadCoverage>& quads);

/// When in-order drawing tests depth: before shading, with the triangle's own depth, or only after
/// it, with the shader's.
enum class DepthTest { early, late };

/// In-order drawing, where shading may discard: appends the quads of this triangle with the samples
/// that are covered and (with an early test) pass the depth test, and writes nothing. By 8x8 blocks
/// of the tile row by row, quads row by row within a block.
void collect_passing(const ScreenTriangle& triangle, std::uint32_t index, const TileBuffer& tile,
                     std::vector<QuadCoverage>& quads, DepthTest test = DepthTest::early);

/// After shading: writes the triangle's own depth and index to the samples set in `quad` (a subset
/// of what collect_passing gave), testing again.
void write_quad(const ScreenTriangle& triangle, const QuadCoverage& quad, TileBuffer& tile);

/// The same with the shader's depths, one per lane, clamped to [0, 1] (NaN gives 0). Returns the
/// samples that passed, per lane.
std::array<std::uint16_t, 4> write_quad_depth(const QuadCoverage& quad,
                                              const std::array<float, 4>& depth, TileBuffer& tile);

}  // namespace quadrel
