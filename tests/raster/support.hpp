// Shared by the tests of this room: clip positions from window positions, coverage maps, and an
// oracle of coverage.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "quadrel/raster/assemble.hpp"
#include "quadrel/raster/coverage.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "random.hpp"
#include "raster/planted.hpp"

namespace quadrel::test {

/// A window position in pixels, with clip w and window depth.
struct Corner {
    double x = 0, y = 0;
    double w = 1, depth = 0.5;
};
using Corners = std::array<Corner, 3>;

/// The clip position that the viewport takes to the corner.
inline glm::dvec4 to_clip(const Corner& c, const Viewport& viewport) {
    const double x = 2 * c.x / viewport.width - 1, y = 2 * c.y / viewport.height - 1;
    const bool gl = viewport.conventions == Conventions::gl;
    const bool d3d = viewport.conventions == Conventions::d3d;
    return {x * c.w, (d3d ? -y : y) * c.w, (gl ? 2 * c.depth - 1 : c.depth) * c.w, c.w};
}

inline std::array<glm::dvec4, 3> to_clip(const Corners& c, const Viewport& viewport) {
    return {to_clip(c[0], viewport), to_clip(c[1], viewport), to_clip(c[2], viewport)};
}

/// The front end under test; each member is the real one unless an error is planted.
struct FrontEnd {
    std::function<SetupOutcome(const std::array<glm::dvec4, 3>&, const RasterState&,
                               ScreenTriangle&)>
        set_up = set_up_triangle;
    std::function<void(const ScreenTriangle&, std::uint32_t, TileBuffer&)> draw = rasterize;
    std::function<void(const TileBuffer&, std::vector<QuadCoverage>&)> collect = collect_quads;
};

FrontEnd front_end(Planted planted = Planted::none);

/// y down, as the published examples have it.
inline RasterState y_down(int width, int height) {
    RasterState state;
    state.viewport = {width, height, Conventions::vulkan};
    return state;
}

/// How often each pixel of the frame is covered, with the sign of the snapped area.
struct CoverageMap {
    int width, height;
    std::vector<int> count, winding;

    CoverageMap(int w, int h)
        : width(w), height(h), count(std::size_t(w) * h), winding(std::size_t(w) * h) {}
    int at(int x, int y) const { return count[std::size_t(y) * width + x]; }
    int total() const {
        int sum = 0;
        for (int n : count) sum += n;
        return sum;
    }
};

/// Adds a triangle to the map; false if it was not drawn.
inline bool cover(const FrontEnd& front, const std::array<glm::dvec4, 3>& clip,
                  const RasterState& state, CoverageMap& map) {
    ScreenTriangle triangle;
    if (front.set_up(clip, state, triangle) != SetupOutcome::drawn) return false;
    triangle.vertex[0].depth = 0.5;  // coverage alone: no depth test fails
    triangle.depth1 = triangle.depth2 = 0;
    const PixelRect& b = triangle.bounds;
    TileBuffer tile({b.x0 & ~1, b.y0 & ~1, b.x1, b.y1}, 1);
    front.draw(triangle, 0, tile);
    const bool y_up = state.viewport.conventions == Conventions::gl;
    for (int y = b.y0; y < b.y1; ++y)
        for (int x = b.x0; x < b.x1; ++x)
            if (tile.triangle(x, y, 0) == 0) {
                map.count[std::size_t(y) * map.width + x] += 1;
                map.winding[std::size_t(y) * map.width + x] +=
                    triangle.front_facing == y_up ? 1 : -1;
            }
    return true;
}
inline bool cover(const FrontEnd& front, const Corners& corners, const RasterState& state,
                  CoverageMap& map) {
    return cover(front, to_clip(corners, state.viewport), state, map);
}

inline CoverageMap coverage(const FrontEnd& front, const std::vector<Corners>& triangles,
                            const RasterState& state) {
    CoverageMap map(state.viewport.width, state.viewport.height);
    for (const Corners& corners : triangles) cover(front, corners, state, map);
    return map;
}

/// A snapped point, 1/256 pixel.
struct Snapped {
    std::int64_t x, y;
};

/// How often the ring winds around (x + e, y + e^2), e -> 0+, where x turns to y: crossings of a
/// ray along +x, exact. A coverage rule is consistent if it agrees with this.
inline int winding_number(const std::vector<Snapped>& ring, std::int64_t x, std::int64_t y) {
    int winding = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Snapped p = ring[i], q = ring[(i + 1) % ring.size()];
        const std::int64_t cross = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
        if (p.y <= y && y < q.y && cross > 0) ++winding;
        if (q.y <= y && y < p.y && cross < 0) --winding;
    }
    return winding;
}

/// A triangle that must be drawn.
inline ScreenTriangle set_up(const Corners& corners, const RasterState& state) {
    ScreenTriangle t;
    EXPECT_EQ(set_up_triangle(to_clip(corners, state.viewport), state, t), SetupOutcome::drawn);
    return t;
}

}  // namespace quadrel::test
