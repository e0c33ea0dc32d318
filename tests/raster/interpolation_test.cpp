#include "quadrel/raster/interpolation.hpp"

#include <cmath>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

template <class T>
PerVertex<Quad<T>> lanes(const ScreenTriangle& triangle, const QuadPoints& points) {
    T e[3][4];
    attribute_edges(triangle, points, e[0], e[1], e[2]);
    return {load<Quad<T>>(e[0]), load<Quad<T>>(e[1]), load<Quad<T>>(e[2])};
}

template <class T>
PerVertex<Quad<T>> constants(T a, T b, T c) {
    return {Quad<T>(a), Quad<T>(b), Quad<T>(c)};
}

template <class T>
PerVertex<Quad<T>> vertex_w(const ScreenTriangle& t) {
    return constants<T>(t.vertex[0].w, t.vertex[1].w, t.vertex[2].w);
}

using Values = std::array<float, 3>;

/// Interpolates a varying in the four lanes.
template <class T>
Quad<T> evaluate(const ScreenTriangle& t, const QuadPoints& points, const Values& v,
                 Planted planted) {
    PerVertex<Quad<T>> e = lanes<T>(t, points);
    const auto value = constants<T>(v[0], v[1], v[2]);
    if (planted == Planted::linear_interpolation) return interpolate(window_barycentrics(e), value);
    const Quad<T> zero(0);
    if (planted == Planted::clamped_helpers)
        e = {max(e.v0, zero), max(e.v1, zero), max(e.v2, zero)};
    return interpolate(perspective_barycentrics(e, vertex_w<T>(t)), value);
}

/// v/w and 1/w as float planes a + b x + c y anchored at the window's origin.
Quad<float> planes_from_origin(const ScreenTriangle& t, const QuadPoints& points, const Values& v) {
    float plane[2][3] = {};
    for (int i = 0; i < 3; ++i) {
        const float scale = 1 / (float(t.area2) * t.vertex[i].w);
        const EdgeFunction& e = t.edge[i];
        const float f[2] = {v[i], 1};
        for (int p = 0; p < 2; ++p) {
            plane[p][0] += float(e.c) * scale * f[p];
            plane[p][1] += float(e.a) * scale * f[p];
            plane[p][2] += float(e.b) * scale * f[p];
        }
    }
    Quad<float> result;
    for (int k = 0; k < 4; ++k) {
        const auto at = [&](const float* p) {
            return p[0] + p[1] * float(points.x[k]) + p[2] * float(points.y[k]);
        };
        result.lane[k] = at(plane[0]) / at(plane[1]);
    }
    return result;
}

Quad<float> evaluate_float(const ScreenTriangle& t, const QuadPoints& points, const Values& v,
                           Planted planted) {
    if (planted == Planted::planes_from_origin) return planes_from_origin(t, points, v);
    return evaluate<float>(t, points, v, planted);
}

ScreenTriangle set_up(const Corners& corners, const RasterState& state) {
    ScreenTriangle t;
    EXPECT_EQ(set_up_triangle(to_clip(corners, state.viewport), state, t), SetupOutcome::drawn);
    return t;
}

struct Bound {
    double error, allowed;
};

/// Error of lane k and what is promised of it, both from exact integer edges in long double.
Bound bound_of(const ScreenTriangle& t, const QuadPoints& points, const Values& v, double got,
               double unit_roundoff, int k) {
    const QuadEdges edges = edge_values(t, points);
    long double s = 0, absolute = 0, sum = 0, absolute_sum = 0;
    for (int i = 0; i < 3; ++i) {
        const long double q = static_cast<long double>(edges[i][k]) / t.vertex[i].w;
        s += q;
        absolute += std::fabs(q);
        sum += q * v[i];
        absolute_sum += std::fabs(q * v[i]);
    }
    const long double kappa = absolute / std::fabs(s);
    if (!(kappa * unit_roundoff < 1.0 / 64)) return {0, 1};
    return {double(std::fabs(got - sum / s)), double(interpolation_error_factor * unit_roundoff *
                                                     kappa * absolute_sum / std::fabs(s))};
}

/// The stated bound holds on covered and helper lanes, for thin triangles and large w ratios.
template <class Evaluate>
testing::AssertionResult bound_holds(Evaluate evaluate_lanes, double unit_roundoff) {
    const RasterState state = y_down(2048, 2048);
    Random random;
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const double x = random.uniform(0, 2000), y = random.uniform(0, 2000);
        const double reach = trial % 3 ? 20 : 800;
        Corners corners;
        Values v;
        for (int i = 0; i < 3; ++i) {
            corners[i] = {x + random.uniform(-reach, reach), y + random.uniform(-reach, reach),
                          random.uniform(0.01, 4)};
            v[i] = float(random.uniform(-1, 1));
        }
        ScreenTriangle t;
        if (set_up_triangle(to_clip(corners, state.viewport), state, t) != SetupOutcome::drawn)
            continue;
        const QuadPoints points = quad_centres(int(x) & ~1, int(y) & ~1);
        const auto value = evaluate_lanes(t, points, v);
        for (int k = 0; k < 4; ++k) {
            const Bound bound = bound_of(t, points, v, double(value.lane[k]), unit_roundoff, k);
            worst = std::max(worst, bound.error / bound.allowed);
            if (!(bound.error <= bound.allowed))
                return testing::AssertionFailure()
                       << "trial " << trial << ": " << bound.error << " > " << bound.allowed;
        }
    }
    // A bound that is never nearly used would say little.
    return worst > 0.1 ? testing::AssertionSuccess() : testing::AssertionFailure() << worst;
}

auto with(Planted planted) {
    return [planted](const ScreenTriangle& t, const QuadPoints& points, const Values& v) {
        return evaluate_float(t, points, v, planted);
    };
}

const Corners published_triangle{Corner{0, 0, 1}, Corner{8, 0, 4}, Corner{0, 8, 1}};

testing::AssertionResult published_values(Planted planted) {
    const ScreenTriangle t = set_up(published_triangle, y_down(8, 8));
    const Values u{0, 1, 0};
    const auto quad = evaluate<double>(t, quad_centres(2, 0), u, planted);
    const auto near = [](double a, double b) { return std::fabs(a - b) < 1e-15; };
    for (int k = 0; k < 4; ++k)
        if (!near(quad.lane[k], k % 2 ? 7.0 / 43 : 5.0 / 49))
            return testing::AssertionFailure() << "lane " << k << ": " << quad.lane[k];
    if (!near(quad.lane[1] - quad.lane[0], 128.0 / 2107))
        return testing::AssertionFailure() << "derivative";
    const auto helper = evaluate<double>(t, quad_centres(6, 0), u, planted);
    return near(helper.lane[3], 15.0 / 19) ? testing::AssertionSuccess()
                                           : testing::AssertionFailure() << "helper";
}

/// Values are affine functions of the snapped positions: at a snapped vertex's own place the value
/// is the vertex's.
testing::AssertionResult follows_snapped_positions(Planted planted) {
    RasterState state = y_down(16, 16);
    state.attributes_from_snapped = planted != Planted::unsnapped_attributes;
    state.subpixel_bits = 4;
    const ScreenTriangle t =
        set_up({Corner{1.52, 1.48}, Corner{12.53, 1.53}, Corner{1.51, 9.47}}, state);
    // All three vertices are snapped to pixel centres: (1.5, 1.5), (12.5, 1.5), (1.5, 9.5).
    const Values v{3, 5, 7};
    const auto at = [&](int x, int y, int k) {
        return evaluate<double>(t, quad_centres(x, y), v, Planted::none).lane[k];
    };
    const bool exact = at(0, 0, 3) == 3 && at(12, 0, 2) == 5 && at(0, 8, 3) == 7;
    return exact ? testing::AssertionSuccess() : testing::AssertionFailure() << at(0, 0, 3);
}

TEST(Interpolation, PublishedPerspective) {
    const auto third = constants<double>(1.0 / 3, 1.0 / 3, 1.0 / 3);
    const auto w = constants<double>(1, 2, 4), f = constants<double>(0, 1, 2);
    EXPECT_DOUBLE_EQ(interpolate(perspective_barycentrics(third, w), f).lane[0], 4.0 / 7);
    EXPECT_DOUBLE_EQ(interpolate(window_barycentrics(third), f).lane[0], 1.0);
    EXPECT_DOUBLE_EQ(interpolate_w(third, w).lane[0], 12.0 / 7);
}

TEST(Interpolation, PublishedQuad) {
    EXPECT_TRUE(published_values(Planted::none));
    EXPECT_FALSE(published_values(Planted::linear_interpolation));
    EXPECT_FALSE(published_values(Planted::clamped_helpers));
    const ScreenTriangle t = set_up(published_triangle, y_down(8, 8));
    int covered = 0;
    for (int i = 0; i < 64; ++i) covered += coverage_mask(t, i % 8, i / 8, 1);
    EXPECT_EQ(covered, 28);
}

TEST(Interpolation, PublishedHelperBarycentrics) {
    const ScreenTriangle t = set_up(published_triangle, y_down(8, 8));
    EXPECT_EQ(coverage_mask(t, 7, 1, 1), 0);
    const auto b = window_barycentrics(lanes<double>(t, quad_centres(6, 0)));
    EXPECT_EQ(b.v0.lane[3], -1.0 / 8);
    EXPECT_EQ(b.v1.lane[3], 15.0 / 16);
    EXPECT_EQ(b.v2.lane[3], 3.0 / 16);
}

TEST(Interpolation, BoundHolds) {
    EXPECT_TRUE(bound_holds(with(Planted::none), 0x1p-24));
    for (Planted planted :
         {Planted::linear_interpolation, Planted::planes_from_origin, Planted::clamped_helpers})
        EXPECT_FALSE(bound_holds(with(planted), 0x1p-24)) << int(planted);
}

TEST(Interpolation, AttributesFollowSnappedPositions) {
    EXPECT_TRUE(follows_snapped_positions(Planted::none));
    EXPECT_FALSE(follows_snapped_positions(Planted::unsnapped_attributes));
}

TEST(Interpolation, UnsnappedAttributesFollowTheGivenPositions) {
    RasterState state = y_down(16, 16);
    state.attributes_from_snapped = false;
    const Corners corners{Corner{1.501, 1.502}, Corner{12.503, 1.499}, Corner{1.498, 9.503}};
    // A value that is x in pixels at the given vertices is x at the pixel centres.
    for (bool reverse : {false, true}) {
        Corners c = corners;
        if (reverse) std::swap(c[1], c[2]);
        const ScreenTriangle t = set_up(c, state);
        const auto x = interpolate(window_barycentrics(lanes<double>(t, quad_centres(4, 4))),
                                   constants<double>(c[0].x, c[1].x, c[2].x));
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(x.lane[k], 4.5 + k % 2, 1e-12);
    }
}

TEST(Interpolation, ConstantsAndVectorsAndFlatValues) {
    const ScreenTriangle t = set_up(published_triangle, y_down(8, 8));
    const auto b =
        perspective_barycentrics(lanes<float>(t, quad_centres(2, 2)), vertex_w<float>(t));
    const PerVertex<vec2<Quad<float>>> v{{Quad<float>(1), Quad<float>(0)},
                                         {Quad<float>(2), Quad<float>(0)},
                                         {Quad<float>(4), Quad<float>(0)}};
    const vec2<Quad<float>> value = interpolate(b, v);
    const auto x = interpolate(b, constants<float>(1, 2, 4));
    for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(value.x.lane[k], x.lane[k]);
        EXPECT_EQ(value.y.lane[k], 0);
    }
    EXPECT_EQ(flat(PerVertex<int>{4, 5, 6}), 4);
    EXPECT_EQ(flat(PerVertex<int>{4, 5, 6}, ProvokingVertex::last), 6);
}

TEST(Interpolation, EdgeValuesSumToTheArea) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        Corners c;
        for (Corner& corner : c) corner = {random.uniform(0, 32), random.uniform(0, 32)};
        const ScreenTriangle t = set_up(c, y_down(32, 32));
        const QuadEdges e = edge_values(t, quad_centres(2 * random.below(16), 6));
        for (int k = 0; k < 4; ++k) EXPECT_EQ(e[0][k] + e[1][k] + e[2][k], t.area2);
    }
}

}  // namespace
}  // namespace quadrel::test
