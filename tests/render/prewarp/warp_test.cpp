// Relief textures warped for a view: what a texel of the warped image shows lies where the eye sees
// it there, is mostly what rays meet first, and nothing is there where nothing was warped to.
#include "render/prewarp/warp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bake/height_plane.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int columns = 96, rows = 80;
constexpr double relief = 0.1;  ///< world units; a tile is 1

using Heights = std::function<double(double u, double v)>;

double hills(double u, double v) {
    const double x = 6.283185307 * u, y = 6.283185307 * v;
    return 0.5 + 0.2 * quadrel::sin(2 * x + 0.5) * quadrel::cos(3 * y) + 0.2 * quadrel::sin(x - y);
}
/// Blocks with walls of a texel.
double blocks(double u, double v) {
    return std::floor(4 * u) - 2 * std::floor(2 * u) + std::floor(3 * v) - 2 * std::floor(1.5 * v) >
                   1
               ? 0.9
               : 0.2;
}

std::shared_ptr<const Texture> map_of(const Heights& heights) {
    Image image;
    image.width = columns;
    image.height = rows;
    image.channels = 1;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            image.values.push_back(
                static_cast<float>(heights((i + 0.5) / columns, (j + 0.5) / rows)));
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

struct Shown {
    double u, v, s;
    bool there;
};
Shown shown(const Texture& warped, int i, int j) {
    const float* const texel =
        warped.level_texels(0, 0) + 4 * (static_cast<std::size_t>(j) * columns + i);
    return {texel[0], texel[1], texel[2], texel[3] == 1};
}

PrewarpRequest request_of(const EyeOverPlane& eye, double seat) {
    return {eye, {0, columns}, {0, rows}, relief, seat};
}

using Warp =
    std::function<std::shared_ptr<const Texture>(const HeightPlane&, const PrewarpRequest&)>;
std::shared_ptr<const Texture> warp(const HeightPlane& heights, const PrewarpRequest& request) {
    return prewarp(heights, request, "a test");
}

struct Eye {
    EyeOverPlane eye;
    double seat;
};
std::vector<Eye> eyes() {
    return {{{0.4, 0.6, 1.1}, 1},  {{-0.3, 0.5, 0.6}, 0.5},   {{1.4, 1.3, 0.7}, 0},
            {{0.5, -0.6, 0.5}, 1}, {{0.4, -0.3, 1, true}, 1}, {{-0.6, 0.2, 1, true}, 0.25}};
}

/// The relief along the ray of the eye through a place of the plane: the first s below the heights;
/// -1 where the ray meets nothing in the unit square, or comes in below them, where relief has no
/// wall. Bilinear between texel centres, as fine as need be.
double first_hit(const HeightPlane& heights, const PrewarpRequest& request, double u, double v) {
    const EyeOverPlane& eye = request.eye;
    const double z_of_s = relief, top = (1 - request.seat) * relief;
    constexpr int steps = 800;
    bool came_in = false;
    for (int k = 0; k <= steps; ++k) {
        const double s = static_cast<double>(k) / steps, z = top - s * z_of_s;
        // The point of the ray that is z above the plane.
        const double t = z / eye.height;
        const double x = eye.at_infinity ? u + eye.u * t : u + (eye.u - u) * t;
        const double y = eye.at_infinity ? v + eye.v * t : v + (eye.v - v) * t;
        const double a = x * columns - 0.5, b = y * rows - 0.5;
        if (!(a >= 0 && b >= 0 && a <= columns - 1 && b <= rows - 1)) continue;
        const int i = std::min(static_cast<int>(a), columns - 2);
        const int j = std::min(static_cast<int>(b), rows - 2);
        const double f = a - i, g = b - j;
        const auto h = [&](int di, int dj) { return double(heights.texel(i + di, j + dj)); };
        const double height =
            (h(0, 0) * (1 - f) + h(1, 0) * f) * (1 - g) + (h(0, 1) * (1 - f) + h(1, 1) * f) * g;
        if (height >= 1 - s) return came_in || k == 0 ? s : -1;
        came_in = true;
    }
    return -1;
}

/// Everything that a warped image shows is on its ray, within `tolerance` texels.
testing::AssertionResult lies_on_rays(const Heights& field, double tolerance, const Warp& make) {
    const auto map = map_of(field);
    const HeightPlane heights(*map, SamplerState());
    for (const Eye& eye : eyes()) {
        const PrewarpRequest request = request_of(eye.eye, eye.seat);
        const auto warped = make(heights, request);
        int there = 0;
        double most = 0;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const Shown seen = shown(*warped, i, j);
                if (!seen.there) continue;
                ++there;
                const double q = (1 - seen.s - eye.seat) * relief;
                const double below = eye.eye.at_infinity ? eye.eye.height : eye.eye.height - q;
                const double u = (seen.u * eye.eye.height - eye.eye.u * q) / below;
                const double v = (seen.v * eye.eye.height - eye.eye.v * q) / below;
                most =
                    std::max({most, std::abs(u * columns - 0.5 - i), std::abs(v * rows - 0.5 - j)});
            }
        if (there < columns * rows / 3) return testing::AssertionFailure() << there << " texels";
        if (!(most <= tolerance)) return testing::AssertionFailure() << most << " texels off";
    }
    return testing::AssertionSuccess();
}

/// Of the texels whose ray meets the relief, `share` show what it meets, within a texel of way.
testing::AssertionResult shows_what_is_nearest(const Heights& field, double share,
                                               const Warp& make) {
    const auto map = map_of(field);
    const HeightPlane heights(*map, SamplerState());
    for (const Eye& eye : eyes()) {
        const PrewarpRequest request = request_of(eye.eye, eye.seat);
        const auto warped = make(heights, request);
        int right = 0, all = 0;
        for (int j = 2; j < rows - 2; j += 3)
            for (int i = 2; i < columns - 2; i += 3) {
                const double s = first_hit(heights, request, (i + 0.5) / columns, (j + 0.5) / rows);
                if (s < 0) continue;
                ++all;
                const Shown seen = shown(*warped, i, j);
                right += seen.there && std::abs(seen.s - s) < 0.06;
            }
        if (all < 300 || right < share * all)
            return testing::AssertionFailure() << right << " of " << all << " texels";
    }
    return testing::AssertionSuccess();
}

/// The request changed before it is warped.
Warp with(const std::function<void(PrewarpRequest&)>& change) {
    return [change](const HeightPlane& heights, PrewarpRequest request) {
        change(request);
        return warp(heights, request);
    };
}

TEST(Prewarp, WhatIsShownLiesOnTheRay) {
    EXPECT_TRUE(lies_on_rays(hills, 0.02, warp));
    EXPECT_TRUE(lies_on_rays(blocks, 0.5, warp)) << "between the ends of walls";
    EXPECT_FALSE(lies_on_rays(hills, 0.02, with([](auto& r) { r.depth *= 1.1; })));
    EXPECT_FALSE(lies_on_rays(hills, 0.02, with([](auto& r) { r.seat = 0.7 - 0.4 * r.seat; })));
    EXPECT_FALSE(lies_on_rays(hills, 0.02, with([](auto& r) { r.eye.u = -r.eye.u; })));
    EXPECT_FALSE(lies_on_rays(hills, 0.02, with([](auto& r) { r.eye.at_infinity = true; })));
}

TEST(Prewarp, ShowsWhatIsNearest) {
    EXPECT_TRUE(shows_what_is_nearest(hills, 0.99, warp));
    EXPECT_TRUE(shows_what_is_nearest(blocks, 0.85, warp));
    // The heights turned over: what is far comes last.
    EXPECT_FALSE(
        shows_what_is_nearest(blocks, 0.85, [](const HeightPlane& heights, PrewarpRequest request) {
            const auto upside_down = map_of([](double u, double v) { return 1.1 - blocks(u, v); });
            (void)heights;
            return warp(HeightPlane(*upside_down, SamplerState()), request);
        }));
    EXPECT_FALSE(shows_what_is_nearest(hills, 0.99, with([](auto& r) { r.seat = 1 - r.seat; })));
}

TEST(Prewarp, ReliefInItsPlaneStaysWhereItIs) {
    const auto map = map_of([](double, double) { return 0.5; });
    const HeightPlane heights(*map, SamplerState());
    const auto warped = warp(heights, request_of({0.3, 0.8, 0.4}, 0.5));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const Shown seen = shown(*warped, i, j);
            ASSERT_TRUE(seen.there) << i << ", " << j;
            EXPECT_NEAR(seen.u, (i + 0.5) / columns, 1e-6);
            EXPECT_NEAR(seen.v, (j + 0.5) / rows, 1e-6);
            EXPECT_EQ(seen.s, 0.5);
        }
}

TEST(Prewarp, NothingIsSeenFromTheSideOrFromWithin) {
    const auto map = map_of(hills);
    const HeightPlane heights(*map, SamplerState());
    for (const double height : {0.0, 0.001}) {
        const auto warped = warp(heights, request_of({0.3, 0.8, height}, 0));
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) EXPECT_FALSE(shown(*warped, i, j).there);
    }
}

}  // namespace
}  // namespace quadrel::render_tests
