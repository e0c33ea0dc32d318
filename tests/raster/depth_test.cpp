#include <cmath>

#include "quadrel/raster/depth_format.hpp"
#include "raster/support.hpp"

namespace quadrel::test {
namespace {

constexpr int depth_size = 32;

Corners random_corners(Random& random, double low, double high) {
    Corners corners;
    for (Corner& c : corners)
        c = {random.uniform(-4, depth_size + 4), random.uniform(-4, depth_size + 4),
             random.uniform(0.2, 5), random.uniform(low, high)};
    return corners;
}

/// The plane through the snapped vertices, by Cramer's rule in long double.
long double plane_depth(const ScreenTriangle& t, int x, int y) {
    const auto& v = t.vertex;
    const long double ax = v[1].x - v[0].x, ay = v[1].y - v[0].y;
    const long double bx = v[2].x - v[0].x, by = v[2].y - v[0].y;
    const long double px = x * 256 + 128 - v[0].x, py = y * 256 + 128 - v[0].y;
    const long double d = ax * by - bx * ay, s = px * by - bx * py, r = ax * py - px * ay;
    return v[0].depth + (s * (v[1].depth - v[0].depth) + r * (v[2].depth - v[0].depth)) / d;
}

/// Depth is linear in the window, clamped, right to a float rounding; whatever the vertices' w.
testing::AssertionResult is_linear_and_clamped(const FrontEnd& front) {
    const RasterState state = y_down(depth_size, depth_size);
    Random random;
    for (int i = 0; i < 300; ++i) {
        const bool leaves = i % 2;
        const Corners corners = random_corners(random, leaves ? -0.5 : 0, leaves ? 1.5 : 1);
        ScreenTriangle t;
        if (set_up_triangle(to_clip(corners, state.viewport), state, t) != SetupOutcome::drawn)
            continue;
        TileBuffer tile({0, 0, depth_size, depth_size}, 1);
        front.draw(t, 0, tile);
        for (int y = 0; y < depth_size; ++y)
            for (int x = 0; x < depth_size; ++x) {
                if (tile.triangle(x, y, 0) != 0) continue;
                const float z = tile.depth(x, y, 0);
                const long double exact = std::min(1.0L, std::max(0.0L, plane_depth(t, x, y)));
                if (!(z >= 0 && z <= 1)) return testing::AssertionFailure() << "range " << z;
                if (std::fabs(z - exact) > 0x1p-25L + 1e-14L)
                    return testing::AssertionFailure() << z << " not " << double(exact);
            }
    }
    return testing::AssertionSuccess();
}

/// The nearest triangle is seen, and of several at one depth the first.
testing::AssertionResult nearest_then_first(const FrontEnd& front) {
    const RasterState state = y_down(depth_size, depth_size);
    Random random;
    std::vector<ScreenTriangle> triangles;
    for (int i = 0; i < 30; ++i) {
        Corners corners = random_corners(random, 0, 0.99);
        for (Corner& c : corners)
            if (i % 3) c.depth = 0.5;
        ScreenTriangle t;
        if (set_up_triangle(to_clip(corners, state.viewport), state, t) == SetupOutcome::drawn)
            triangles.push_back(t);
    }
    TileBuffer tile({0, 0, depth_size, depth_size}, 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        front.draw(triangles[i], std::uint32_t(i), tile);
    for (int y = 0; y < depth_size; ++y)
        for (int x = 0; x < depth_size; ++x) {
            std::uint32_t first = no_triangle;
            float nearest = 1;
            for (std::size_t i = 0; i < triangles.size(); ++i) {
                const float z = depth_at(triangles[i], x * 256 + 128, y * 256 + 128);
                if (!coverage_mask(triangles[i], x, y, 1) || !(z < nearest)) continue;
                nearest = z;
                first = std::uint32_t(i);
            }
            if (tile.triangle(x, y, 0) != first)
                return testing::AssertionFailure() << x << "," << y;
        }
    return testing::AssertionSuccess();
}

TEST(Depth, IsLinearAndClamped) {
    EXPECT_TRUE(is_linear_and_clamped(front_end()));
    EXPECT_FALSE(is_linear_and_clamped(front_end(Planted::perspective_depth)));
    EXPECT_FALSE(is_linear_and_clamped(front_end(Planted::unclamped_depth)));
}

TEST(Depth, NearestThenFirst) {
    EXPECT_TRUE(nearest_then_first(front_end()));
    EXPECT_FALSE(nearest_then_first(front_end(Planted::later_wins_ties)));
    EXPECT_FALSE(nearest_then_first(front_end(Planted::nearest_by_order)));
}

TEST(Depth, ReversedZKeepsTheLargest) {
    TileBuffer tile({0, 0, 2, 2}, 1, DepthCompare::greater);
    EXPECT_EQ(tile.depth(0, 0, 0), 0);
    EXPECT_FALSE(tile.passes(0, 0, 0, 0.0f, 0));
    EXPECT_TRUE(tile.passes(0, 0, 0, 0.25f, 0));
    tile.write(0, 0, 0, 0.25f, 3);
    EXPECT_FALSE(tile.passes(0, 0, 0, 0.125f, 0));
    EXPECT_TRUE(tile.passes(0, 0, 0, 0.25f, 2));
    EXPECT_FALSE(tile.passes(0, 0, 0, 0.25f, 3));
    EXPECT_FALSE(tile.passes(0, 0, 0, 0.25f, 4));
}

TEST(Depth, PublishedCodes) {
    EXPECT_EQ(depth_code(DepthFormat::unorm16, 0.5f), 32768u);
    EXPECT_EQ(depth_code(DepthFormat::unorm24, 0.5f), 8388608u);
    EXPECT_EQ(depth_code(DepthFormat::unorm24, 0.1f), 1677722u);
    EXPECT_EQ(depth_code(DepthFormat::unorm24, 1.0f), max_depth_code(DepthFormat::unorm24));
    EXPECT_EQ(depth_code(DepthFormat::float32, std::nanf("")), 0u);
}

TEST(Depth, PublishedBiasUnits) {
    EXPECT_EQ(depth_bias_unit(DepthFormat::float32, 0.75f), 5.960464477539063e-08);
    EXPECT_EQ(depth_bias_unit(DepthFormat::float32, 1.0f), 0x1p-23);
    EXPECT_EQ(depth_bias_unit(DepthFormat::unorm24, 1.0f), 0x1p-24);
    EXPECT_EQ(depth_bias_unit(DepthFormat::unorm16, 1.0f), 0x1p-16);
}

}  // namespace
}  // namespace quadrel::test
