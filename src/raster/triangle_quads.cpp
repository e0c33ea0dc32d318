#include "quadrel/raster/triangle_quads.hpp"

namespace quadrel {
namespace {

std::vector<QuadCoverage> covered_quads(const ScreenTriangle& triangle) {
    std::vector<QuadCoverage> quads;
    const PixelRect& bounds = triangle.bounds;
    for (int y = bounds.y0 & ~1; y < bounds.y1; y += 2) {
        for (int x = bounds.x0 & ~1; x < bounds.x1; x += 2) {
            QuadCoverage quad{x, y, 0, {}};
            std::uint16_t any = 0;
            for (int lane = 0; lane < 4; ++lane) {
                const auto i = static_cast<std::size_t>(lane);
                quad.samples[i] =
                    coverage_mask(triangle, lane_x(quad, lane), lane_y(quad, lane), 1);
                any |= quad.samples[i];
            }
            if (any != 0) quads.push_back(quad);
        }
    }
    return quads;
}

}  // namespace

std::vector<TriangleQuads> triangle_quads(const std::array<glm::vec4, 3>& clip,
                                          const RasterState& state) {
    std::vector<AssembledTriangle> pieces;
    PrimitiveCounts counts;
    assemble_triangle(clip, state, pieces, counts);
    std::vector<TriangleQuads> out;
    for (const AssembledTriangle& piece : pieces)
        out.push_back({piece, covered_quads(piece.screen)});
    return out;
}

}  // namespace quadrel
