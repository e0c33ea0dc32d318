#include "raster/placed.hpp"

#include <array>

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

/// Of an edge function's unit.
constexpr std::int64_t finer = place_units / subpixel_units;

/// The edge functions at a place, by `finer`. Coefficients are below 2^28, constants below 2^56.
std::array<std::int64_t, 3> edges_at(const ScreenTriangle& triangle, int x, int y,
                                     SamplePlace place) {
    const std::int64_t px = std::int64_t(x) * place_units + place.x;
    const std::int64_t py = std::int64_t(y) * place_units + place.y;
    std::array<std::int64_t, 3> values;
    for (std::size_t i = 0; i < 3; ++i) {
        const EdgeFunction& edge = triangle.edge[i];
        values[i] = edge.a * px + edge.b * py + edge.c * finer;
    }
    return values;
}

/// A threshold of 1 asks for more than 0, in any unit.
bool is_inside(const ScreenTriangle& triangle, const std::array<std::int64_t, 3>& edges) {
    for (std::size_t i = 0; i < 3; ++i)
        if (edges[i] < triangle.edge[i].threshold) return false;
    return true;
}

/// As depth_at.
float depth_of(const ScreenTriangle& triangle, const std::array<std::int64_t, 3>& edges) {
    const double e1 = static_cast<double>(edges[1]) / finer;
    const double e2 = static_cast<double>(edges[2]) / finer;
    const double depth = triangle.vertex[0].depth + (e1 * triangle.depth1 + e2 * triangle.depth2);
    return static_cast<float>(depth < 0 ? 0 : depth > 1 ? 1 : depth);
}

}  // namespace

void QuadPlaces::reset(const PixelRect& rect) {
    QUADREL_CHECK(rect.x0 % 2 == 0, rect.x0);
    QUADREL_CHECK(rect.y0 % 2 == 0, rect.y0);
    rect_ = rect;
    columns_ = std::size_t(rect.width() + 1) / 2;
    quads_.assign(columns_ * (std::size_t(rect.height() + 1) / 2), {});
}

void rasterize(const ScreenTriangle& triangle, std::uint32_t index, const QuadPlaces& places,
               TileBuffer& tile) {
    const PixelRect area = intersect(tile.rect(), triangle.bounds);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            if (!places.is_drawn(x, y)) continue;
            const auto edges = edges_at(triangle, x, y, places.at(x, y));
            if (!is_inside(triangle, edges)) continue;
            const float depth = depth_of(triangle, edges);
            if (tile.passes(x, y, 0, depth, index)) tile.write(x, y, 0, depth, index);
        }
}

void collect_passing(const ScreenTriangle& triangle, std::uint32_t index, const QuadPlaces& places,
                     const TileBuffer& tile, std::vector<QuadCoverage>& quads, DepthTest test) {
    const PixelRect area = intersect(tile.rect(), triangle.bounds);
    for (int y = area.y0 & ~1; y < area.y1; y += 2)
        for (int x = area.x0 & ~1; x < area.x1; x += 2) {
            if (!places.is_drawn(x, y)) continue;
            QuadCoverage quad{x, y, index, {}};
            for (int lane = 0; lane < 4; ++lane) {
                const int px = lane_x(quad, lane), py = lane_y(quad, lane);
                if (!area.contains(px, py)) continue;
                const auto edges = edges_at(triangle, px, py, places.at(x, y));
                const bool passes = is_inside(triangle, edges) &&
                                    (test == DepthTest::late ||
                                     tile.passes(px, py, 0, depth_of(triangle, edges), index));
                quad.samples[static_cast<std::size_t>(lane)] = passes;
            }
            if (quad.is_any()) quads.push_back(quad);
        }
}

void write_quad(const ScreenTriangle& triangle, const QuadCoverage& quad, const QuadPlaces& places,
                TileBuffer& tile) {
    for (int lane = 0; lane < 4; ++lane) {
        if (!quad.samples[static_cast<std::size_t>(lane)]) continue;
        const int x = lane_x(quad, lane), y = lane_y(quad, lane);
        const float depth = depth_of(triangle, edges_at(triangle, x, y, places.at(x, y)));
        if (tile.passes(x, y, 0, depth, quad.triangle)) tile.write(x, y, 0, depth, quad.triangle);
    }
}

void attribute_edges(const ScreenTriangle& triangle, const QuadCoverage& quad, SamplePlace place,
                     double* e0, double* e1, double* e2) {
    double* const out[3] = {e0, e1, e2};
    for (int lane = 0; lane < 4; ++lane) {
        const auto edges = edges_at(triangle, lane_x(quad, lane), lane_y(quad, lane), place);
        for (std::size_t i = 0; i < 3; ++i) out[i][lane] = static_cast<double>(edges[i]);
    }
}

}  // namespace quadrel
