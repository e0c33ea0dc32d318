// Clipping: planes, weights, shared edges, and coverage of a plane that passes the eye.
#include "quadrel/raster/clip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

using Positions = std::array<glm::vec4, 3>;
using Clip = std::function<ClippedPolygon(const Positions&, const Viewport&)>;

const Viewport frame{64, 64, Conventions::gl};

/// The near plane alone, each cut taken from the edge's first vertex to its second.
ClippedPolygon cut_in_winding_order(const Positions& clip, const Viewport&) {
    ClippedPolygon out;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4 a(clip[i]), b(clip[(i + 1) % 3]);
        const double da = a.z + a.w, db = b.z + b.w;
        if (da >= 0) out.vertex[out.count++].position = a;
        if ((da < 0) == (db < 0)) continue;
        const double t = da / (da - db);
        out.vertex[out.count++].position = a * (1 - t) + b * t;
    }
    out.status = ClipStatus::clipped;
    return out;
}

ClippedPolygon cut_without_w(const Positions& clip, const Viewport& viewport) {
    ClippedPolygon out = clip_triangle(clip, viewport);
    for (int i = 0; i < 3; ++i) out.vertex[i].position = glm::dvec4(clip[i]);
    out.count = 3;
    return out;
}

Clip clip_with(Planted planted) {
    if (planted == Planted::cut_in_winding_order) return cut_in_winding_order;
    if (planted == Planted::cut_without_w) return cut_without_w;
    return clip_triangle;
}

glm::vec4 random_position(Random& random) {
    const auto coordinate = [&] { return float(random.uniform(-3, 3)); };
    return {coordinate(), coordinate(), coordinate(), float(random.uniform(-1, 3))};
}

bool same(const glm::dvec4& a, const glm::dvec4& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

bool is_vertex(const ClippedPolygon& polygon, const glm::dvec4& p) {
    for (int i = 0; i < polygon.count; ++i)
        if (same(polygon.vertex[i].position, p)) return true;
    return false;
}

/// Two triangles on either side of an edge: what is left of the edge is the same for both.
testing::AssertionResult shared_edges_stay_shared(const Clip& clip, int trials) {
    Random random;
    for (int i = 0; i < trials; ++i) {
        const glm::vec4 a = random_position(random), b = random_position(random);
        const ClippedPolygon left = clip({a, b, random_position(random)}, frame);
        const ClippedPolygon right = clip({random_position(random), b, a}, frame);
        for (int k = 0; k < left.count; ++k) {
            const ClipVertex& vertex = left.vertex[k];
            const glm::dvec4 on_edge =
                glm::dvec4(a) +
                (glm::dvec4(b) - glm::dvec4(a)) * ((vertex.position.w - a.w) / (b.w - a.w));
            const glm::dvec4 off = vertex.position - on_edge;
            if (std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)}) > 1e-10) continue;
            if (!is_vertex(right, vertex.position))
                return testing::AssertionFailure() << "trial " << i << " vertex " << k;
        }
    }
    return testing::AssertionSuccess();
}

/// Every vertex is in the volume, and its weights give its position.
testing::AssertionResult stays_in_volume(const Clip& clip, Conventions conventions) {
    Random random;
    const Viewport viewport{64, 64, conventions};
    for (int i = 0; i < 5000; ++i) {
        Positions p{random_position(random), random_position(random), random_position(random)};
        // The eye itself, and points at infinity in the plane of the eye.
        if (i % 5 == 0) p[i % 3] = glm::vec4(0);
        if (i % 7 == 0) p[i % 3].z = p[i % 3].w = 0;
        const ClippedPolygon polygon = clip(p, viewport);
        for (int k = 0; k < polygon.count; ++k) {
            const ClipVertex& v = polygon.vertex[k];
            const double near = conventions == Conventions::gl ? -v.position.w : 0;
            if (v.position.w < minimum_w || v.position.z < near - 1e-14 ||
                v.position.z > v.position.w + 1e-14)
                return testing::AssertionFailure() << "outside in trial " << i;
            glm::dvec4 sum(0.0);
            for (int n = 0; n < 3; ++n) sum += glm::dvec4(p[n]) * v.weight[n];
            if (glm::length(sum - v.position) > 1e-9)
                return testing::AssertionFailure() << "weights in trial " << i;
        }
    }
    return testing::AssertionSuccess();
}

using WindowWeights = std::function<std::array<double, 3>(const ClipVertex&, const Positions&)>;

WindowWeights window_weights_with(Planted planted) {
    if (planted == Planted::none) return window_linear_weights;
    return [](const ClipVertex& vertex, const Positions&) { return vertex.weight; };
}

/// A function that is linear in the window is so at clip vertices.
testing::AssertionResult window_weights_are_linear(const WindowWeights& weights) {
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const Positions p{random_position(random), random_position(random),
                          random_position(random)};
        const ClippedPolygon polygon = clip_triangle(p, frame);
        for (int k = 0; k < polygon.count; ++k) {
            const glm::dvec4 q = polygon.vertex[k].position;
            const auto weight = weights(polygon.vertex[k], p);
            double sum = 0, scale = 0;
            for (int n = 0; n < 3; ++n) {
                const double f = 2.0 * p[n].x / p[n].w - 3.0 * p[n].y / p[n].w + 1;
                sum += weight[n] * f;
                scale += std::fabs(weight[n] * f);
            }
            const double expected = 2 * q.x / q.w - 3 * q.y / q.w + 1;
            if (std::fabs(sum - expected) > 1e-11 * (scale + std::fabs(expected)))
                return testing::AssertionFailure() << sum << " not " << expected;
        }
    }
    return testing::AssertionSuccess();
}

/// A plane y = height(x, z) in eye space as a grid of (2n)^2 x 2 triangles, looked at from the
/// origin towards -z, so that many triangles reach behind the eye.
struct Ground {
    double height, slope;
    double extent = 20;
    int n = 20;

    glm::vec4 clip(double x, double z) const {
        // 90 degrees, near 1, far 100.
        const double y = height + slope * x, near = 1, far = 100;
        return glm::vec4(float(x), float(y),
                         float((far + near) / (near - far) * z + 2 * far * near / (near - far)),
                         float(-z));
    }
    std::vector<Positions> triangles() const {
        std::vector<Positions> result;
        const double cell = extent / n;
        for (int i = -n; i < n; ++i)
            for (int j = -n; j < n; ++j) {
                const glm::vec4 a = clip(i * cell, j * cell), b = clip((i + 1) * cell, j * cell);
                const glm::vec4 c = clip(i * cell, (j + 1) * cell);
                const glm::vec4 d = clip((i + 1) * cell, (j + 1) * cell);
                result.push_back({a, b, d});
                result.push_back({a, d, c});
            }
        return result;
    }
    /// 1 if the pixel's ray surely meets the mesh between the near plane and the far rim, 0 if it
    /// surely doesn't, -1 near the border.
    int expected(int px, int py) const {
        const double x = 2 * (px + 0.5) / frame.width - 1, y = 2 * (py + 0.5) / frame.height - 1;
        // Eye-space point s (x, y, -1) with s y = height + slope s x.
        const double s = height / (y - slope * x);
        const double pixel = 2.0 / frame.height;
        const double s0 = height / (y - slope * x - pixel), s1 = height / (y - slope * x + pixel);
        if (s0 * s1 < 0) return -1;
        const auto inside = [&](double t) {
            return t > 1 && t < extent && t * std::fabs(x) < extent;
        };
        const bool in = inside(s) && inside(s * 1.05 + 0.1) && inside(s0) && inside(s1);
        const bool out =
            !inside(s) && !inside(s * 0.9) && !inside(s * 1.1) && !inside(s0) && !inside(s1);
        return in ? 1 : out ? 0 : -1;
    }
};

testing::AssertionResult ground_is_watertight(const FrontEnd& front, const Clip& clip) {
    Random random;
    int decided = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Ground ground{random.uniform(-3, -0.2), random.uniform(-0.3, 0.3)};
        RasterState state;
        state.viewport = frame;
        CoverageMap map(frame.width, frame.height);
        for (const Positions& p : ground.triangles()) {
            const ClippedPolygon polygon = clip(p, frame);
            for (int i = 1; i + 1 < polygon.count; ++i)
                cover(front,
                      {polygon.vertex[0].position, polygon.vertex[i].position,
                       polygon.vertex[i + 1].position},
                      state, map);
        }
        for (int y = 0; y < frame.height; ++y)
            for (int x = 0; x < frame.width; ++x) {
                const int expected = ground.expected(x, y);
                if (expected < 0) continue;
                decided += expected;
                const int got = std::abs(map.winding[std::size_t(y) * map.width + x]);
                if (got != expected || map.at(x, y) != expected)
                    return testing::AssertionFailure() << "trial " << trial << " pixel " << x << ","
                                                       << y << ": " << map.at(x, y);
            }
    }
    return decided > 10000 ? testing::AssertionSuccess() : testing::AssertionFailure() << decided;
}

TEST(Clip, WhatIsInsideIsUntouched) {
    const Positions p{glm::vec4{5, 0, 0, 1}, glm::vec4{0, 1, .5f, 1}, glm::vec4{-7, 0, 0, 2}};
    const ClippedPolygon polygon = clip_triangle(p, frame);
    EXPECT_EQ(polygon.status, ClipStatus::inside);
    ASSERT_EQ(polygon.count, 3);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(same(polygon.vertex[i].position, glm::dvec4(p[i])));
        for (int k = 0; k < 3; ++k) EXPECT_EQ(polygon.vertex[i].weight[k], i == k ? 1 : 0);
    }
}

TEST(Clip, SharedEdgesStayShared) {
    EXPECT_TRUE(shared_edges_stay_shared(clip_with(Planted::none), 20000));
    EXPECT_FALSE(shared_edges_stay_shared(clip_with(Planted::cut_in_winding_order), 20000));
}

TEST(Clip, StaysInVolume) {
    for (Conventions conventions : {Conventions::gl, Conventions::vulkan, Conventions::d3d}) {
        EXPECT_TRUE(stays_in_volume(clip_with(Planted::none), conventions));
        EXPECT_FALSE(stays_in_volume(clip_with(Planted::cut_without_w), conventions));
    }
}

TEST(Clip, WindowWeightsAreLinear) {
    EXPECT_TRUE(window_weights_are_linear(window_weights_with(Planted::none)));
    EXPECT_FALSE(window_weights_are_linear(window_weights_with(Planted::clip_weights_in_window)));
}

TEST(Clip, PlaneThroughTheEyeIsWatertight) {
    EXPECT_TRUE(ground_is_watertight(front_end(), clip_triangle));
    EXPECT_FALSE(ground_is_watertight(front_end(Planted::slivers_dropped), clip_triangle));
    EXPECT_FALSE(ground_is_watertight(front_end(Planted::inclusive_edges), clip_triangle));
    EXPECT_FALSE(ground_is_watertight(front_end(), clip_with(Planted::cut_without_w)));
}

TEST(Clip, NonFinitePositionsDiscardThePrimitive) {
    RasterState state;
    state.viewport = frame;
    for (float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (int i = 0; i < 12; ++i) {
            Positions p{glm::vec4{0, 0, 0, 1}, glm::vec4{1, 0, 0, 1}, glm::vec4{0, 1, 0, 1}};
            p[i / 4][i % 4] = bad;
            std::vector<AssembledTriangle> out;
            PrimitiveCounts counts;
            assemble_triangle(p, state, out, counts);
            EXPECT_TRUE(out.empty());
            EXPECT_EQ(counts, (PrimitiveCounts{.submitted = 1, .non_finite = 1}));
        }
}

TEST(Clip, EverythingIsCounted) {
    RasterState state;
    state.viewport = frame;
    const auto counts = [&](const Positions& p, Cull cull = Cull::none) {
        std::vector<AssembledTriangle> out;
        PrimitiveCounts result;
        state.cull = cull;
        assemble_triangle(p, state, out, result);
        EXPECT_EQ(result.drawn, out.size());
        return result;
    };
    const glm::vec4 a{0, 0, 0, 1}, b{.5f, 0, 0, 1}, c{0, .5f, 0, 1}, behind{0, 0, -3, 1};
    EXPECT_EQ(counts({a, b, c}), (PrimitiveCounts{.submitted = 1, .drawn = 1}));
    EXPECT_EQ(counts({a, c, b}, Cull::back), (PrimitiveCounts{.submitted = 1, .culled = 1}));
    EXPECT_EQ(counts({a, b, b}), (PrimitiveCounts{.submitted = 1, .zero_area = 1}));
    EXPECT_EQ(counts({behind, behind, behind}), (PrimitiveCounts{.submitted = 1, .outside = 1}));
    EXPECT_EQ(counts({c, b, {.6f, .4f, -2, 1}}),
              (PrimitiveCounts{.submitted = 1, .clipped = 1, .drawn = 2}));
    EXPECT_EQ(
        counts(Positions{glm::vec4{5, 0, 0, 1}, glm::vec4{6, 0, 0, 1}, glm::vec4{5, 1, 0, 1}}),
        (PrimitiveCounts{.submitted = 1, .off_frame = 1}));
}

TEST(Clip, FarReachingTrianglesCoverTheFrameExactlyOnce) {
    // Four triangles around the centre reach beyond what coordinates can hold.
    for (float far : {10.0f, 1e4f, 1e7f, 1e20f, 1e37f}) {
        RasterState state;
        state.viewport = frame;
        const glm::vec4 centre{.1f, .2f, 0, 1};
        const glm::vec4 ring[] = {{far, 0, 0, 1}, {0, far, 0, 1}, {-far, 0, 0, 1}, {0, -far, 0, 1}};
        std::vector<AssembledTriangle> out;
        PrimitiveCounts counts;
        for (int i = 0; i < 4; ++i)
            assemble_triangle({ring[i], ring[(i + 1) % 4], centre}, state, out, counts);
        std::vector<int> covered(64 * 64);
        for (const AssembledTriangle& piece : out)
            for (int i = 0; i < 64 * 64; ++i)
                covered[i] += coverage_mask(piece.screen, i % 64, i / 64, 1);
        EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 64 * 64) << far;
    }
}

TEST(Clip, WeighedVaryingsKeepOriginalBits) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(weigh({0, 1, 0}, nan, 0.1f, nan), 0.1f);
    EXPECT_TRUE(std::signbit(weigh({0, 0, 1}, 1, 1, -0.0f)));
    EXPECT_EQ(weigh({0.25, 0.75, 0}, 4, 8, nan), 7.0f);
}

}  // namespace
}  // namespace quadrel::test
