#include "raster/solid_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "quadrel/raster/samples.hpp"

namespace quadrel {
namespace {

struct Corner {
    std::int64_t x, y;
};

/// The corners of the smallest rectangle around all samples: what is linear has its extremes there.
std::array<Corner, 4> corners_of(const PixelRect& rect, int samples) {
    const auto positions = sample_positions(samples);
    const auto [left, right] = std::ranges::minmax(positions, {}, &SamplePosition::x);
    const auto [low, high] = std::ranges::minmax(positions, {}, &SamplePosition::y);
    const auto at = [](int pixel, std::int32_t offset) {
        return std::int64_t(pixel) * subpixel_units + offset * 16;
    };
    const std::int64_t x0 = at(rect.x0, left.x), x1 = at(rect.x1 - 1, right.x);
    const std::int64_t y0 = at(rect.y0, low.y), y1 = at(rect.y1 - 1, high.y);
    return {{{x0, y0}, {x1, y0}, {x0, y1}, {x1, y1}}};
}

}  // namespace

Cover cover_of(const ScreenTriangle& triangle, const PixelRect& rect, int samples) {
    const auto corners = corners_of(rect, samples);
    Cover cover = Cover::all;
    for (const EdgeFunction& edge : triangle.edge) {
        const auto inside = std::count_if(corners.begin(), corners.end(), [&](const Corner& p) {
            return edge(p.x, p.y) >= edge.threshold;
        });
        if (inside == 0) return Cover::none;
        if (inside < 4) cover = Cover::some;
    }
    return cover;
}

/// The depth of a fragment is linear in the window but for roundings. With z the depths of the
/// vertices, and edges that are nowhere negative nor above twice the area, these are at most 2^-50
/// (|z0| + |z1 - z0| + |z2 - z0|) in double and 2^-25 as float: less than half of the margin.
bool passes_cleared(const ScreenTriangle& triangle, const PixelRect& rect, int samples,
                    DepthCompare compare) {
    constexpr double margin = 0x1p-20, largest = 0x1p20;
    const auto& v = triangle.vertex;
    const double size = std::abs(v[0].depth) + std::abs(v[1].depth - v[0].depth) +
                        std::abs(v[2].depth - v[0].depth);
    if (!(size <= largest)) return false;
    for (const Corner& p : corners_of(rect, samples)) {
        const double depth = depth_at(triangle, p.x, p.y);
        if (!(compare == DepthCompare::less ? depth < 1 - margin : depth > margin)) return false;
    }
    return true;
}

void append_whole_quads(const PixelRect& rect, std::uint32_t triangle, int samples,
                        std::vector<QuadCoverage>& quads) {
    const auto all = static_cast<std::uint16_t>((1u << samples) - 1);
    for (int y = rect.y0; y < rect.y1; y += 2)
        for (int x = rect.x0; x < rect.x1; x += 2)
            quads.push_back({x, y, triangle, {all, all, all, all}});
}

}  // namespace quadrel
