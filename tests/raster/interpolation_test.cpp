#include "quadrel/raster/interpolation.hpp"

#include <bit>
#include <optional>

#include "effort.hpp"
#include "quadrel/raster/snap.hpp"
#include "raster/exact_interpolation.hpp"

namespace quadrel::test {
namespace {

template <class T>
EdgeValues<Quad<T>> lanes(const ScreenTriangle& triangle, const QuadPoints& points) {
    double e[3][4];
    attribute_edges(triangle, points, e[0], e[1], e[2]);
    return {load_wide<Quad<T>>(e[0]), load_wide<Quad<T>>(e[1]), load_wide<Quad<T>>(e[2])};
}

template <class T>
PerVertex<Quad<T>> constants(T a, T b, T c) {
    return {Quad<T>(a), Quad<T>(b), Quad<T>(c)};
}

template <class T>
PerVertex<Quad<T>> vertex_w(const ScreenTriangle& t) {
    return constants<T>(t.vertex[0].w, t.vertex[1].w, t.vertex[2].w);
}

Quad<double> larger(const Quad<double>& a) { return max(a, Quad<double>(0)); }

/// Interpolates a varying in the four lanes.
template <class T>
Quad<T> evaluate(const ScreenTriangle& t, const QuadPoints& points, const Values& v,
                 Planted planted) {
    EdgeValues<Quad<T>> e = lanes<T>(t, points);
    const auto value = constants<T>(v[0], v[1], v[2]);
    if (planted == Planted::linear_interpolation)
        return interpolate(window_barycentrics<Quad<T>>(e), value);
    if (planted == Planted::clamped_helpers) e = {larger(e.v0), larger(e.v1), larger(e.v2)};
    const auto b = perspective_barycentrics(e, vertex_w<T>(t));
    if (planted == Planted::weighted_sum || planted == Planted::float_weights) {
        const auto rounded = [&](const Quad<double>& weight) {
            return planted == Planted::float_weights ? to_wide(from_wide<Quad<float>>(weight))
                                                     : weight;
        };
        return from_wide<Quad<T>>(rounded(b.b0) * to_wide(value.v0) +
                                  rounded(b.b1) * to_wide(value.v1) +
                                  rounded(b.b2) * to_wide(value.v2));
    }
    return interpolate(b, value);
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

/// Triangles of all kinds: small, thin, of a million pixels; w from 1e-3 to 1e6; whole, or cut by
/// the near and far planes. Null if nothing of it is drawn.
std::optional<ScreenTriangle> any_triangle(Random& random, int kind, const RasterState& state) {
    const double x = random.uniform(0, 2000), y = random.uniform(0, 2000);
    const double reach = kind % 3 == 0 ? 1500 : 20, thickness = kind % 3 == 2 ? 0.02 : reach;
    const auto w = [&] { return std::pow(10.0, random.uniform(-3, kind % 2 ? 6 : 0)); };
    const double common = w();
    std::array<glm::vec4, 3> clip;
    for (glm::vec4& corner : clip) {
        const Corner c{x + random.uniform(-reach, reach), y + random.uniform(-thickness, thickness),
                       kind % 4 < 2 ? w() : common * random.uniform(0.5, 2),
                       kind % 5 == 0 ? random.uniform(-1, 2) : 0.5};
        corner = glm::vec4(to_clip(c, state.viewport));
    }
    std::vector<AssembledTriangle> pieces;
    PrimitiveCounts counts;
    assemble_triangle(clip, state, pieces, counts);
    if (pieces.empty()) return {};
    return pieces[std::size_t(random.below(int(pieces.size())))].screen;
}

/// A quad around a random point of the triangle, or next to it.
QuadPoints points_near(const ScreenTriangle& t, Random& random) {
    double a = random.uniform(0, 1), b = random.uniform(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const auto at = [&](auto coordinate) {
        const auto& v = t.vertex;
        const double value =
            (1 - a - b) * v[0].*coordinate + a * v[1].*coordinate + b * v[2].*coordinate;
        return static_cast<int>(value / subpixel_units) & ~1;
    };
    return quad_centres(at(&ScreenVertex::x), at(&ScreenVertex::y));
}

Values any_values(Random& random, int kind) {
    const float base = kind % 2 ? 0 : float(random.uniform(-1000, 1000));
    Values v;
    for (float& x : v) x = base + float(random.uniform(-1, 1));
    return v;
}

/// The stated bound holds on covered and helper lanes of such triangles.
template <class Evaluate>
testing::AssertionResult bound_holds(Evaluate evaluate_lanes) {
    const RasterState state = y_down(2048, 2048);
    Random random;
    double worst = 0;
    for (int trial = 0; trial < 20 * rounds(1000); ++trial) {
        const auto t = any_triangle(random, trial, state);
        if (!t) continue;
        const QuadPoints points = points_near(*t, random);
        const Values v = any_values(random, trial / 7);
        const auto value = evaluate_lanes(*t, points, v);
        const QuadEdges edges = edge_values(*t, points);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto exact = exact_value(*t, edges, k, v);
            if (!exact || exact->kappa > 0x1p40) continue;
            const double error = error_of(*exact, value.lane[k]);
            const double allowed = allowed_error(*exact, value.lane[k]);
            worst = std::max(worst, error / allowed);
            if (!(error <= allowed))
                return testing::AssertionFailure()
                       << "trial " << trial << ", lane " << k << ", kappa " << exact->kappa << ": "
                       << error << " > " << allowed;
        }
    }
    // A bound that is never nearly used would say little.
    return worst > 0.02 ? testing::AssertionSuccess() : testing::AssertionFailure() << worst;
}

/// A value that all vertices share stays what it is, bit for bit, in helper lanes too.
testing::AssertionResult constants_are_kept(Planted planted) {
    const RasterState state = y_down(2048, 2048);
    Random random;
    const float infinity = std::numeric_limits<float>::infinity();
    for (int trial = 0; trial < rounds(1000); ++trial) {
        const auto t = any_triangle(random, trial, state);
        if (!t) continue;
        const QuadPoints points = points_near(*t, random);
        for (const float c : {-0.0f, 0.1f, -3e38f, infinity, float(random.uniform(-1, 1))}) {
            const Quad<float> value = evaluate<float>(*t, points, {c, c, c}, planted);
            for (const float got : value.lane)
                if (std::bit_cast<std::uint32_t>(got) != std::bit_cast<std::uint32_t>(c))
                    return testing::AssertionFailure() << c << " became " << got;
        }
    }
    return testing::AssertionSuccess();
}

template <class T>
auto with(Planted planted) {
    return [planted](const ScreenTriangle& t, const QuadPoints& points, const Values& v) {
        if constexpr (std::same_as<T, float>)
            return evaluate_float(t, points, v, planted);
        else
            return evaluate<T>(t, points, v, planted);
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
    state.subpixel_bits = planted == Planted::unsnapped_attributes ? 8 : 4;
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
    using F = Quad<double>;
    const EdgeValues<F> third = constants<double>(1.0 / 3, 1.0 / 3, 1.0 / 3);
    const auto w = constants<double>(1, 2, 4), f = constants<double>(0, 1, 2);
    EXPECT_DOUBLE_EQ(interpolate(perspective_barycentrics(third, w), f).lane[0], 4.0 / 7);
    EXPECT_DOUBLE_EQ(interpolate(window_barycentrics<F>(third), f).lane[0], 1.0);
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
    const auto b = window_barycentrics<Quad<double>>(lanes<double>(t, quad_centres(6, 0)));
    EXPECT_DOUBLE_EQ(b.b0.lane[3], -1.0 / 8);
    EXPECT_DOUBLE_EQ(b.b1.lane[3], 15.0 / 16);
    EXPECT_DOUBLE_EQ(b.b2.lane[3], 3.0 / 16);
}

TEST(Interpolation, BoundHolds) {
    EXPECT_TRUE(bound_holds(with<float>(Planted::none)));
    EXPECT_TRUE(bound_holds(with<double>(Planted::none)));
    for (Planted planted : {Planted::linear_interpolation, Planted::planes_from_origin,
                            Planted::float_weights, Planted::clamped_helpers})
        EXPECT_FALSE(bound_holds(with<float>(planted))) << int(planted);
}

TEST(Interpolation, ConstantsAreKept) {
    EXPECT_TRUE(constants_are_kept(Planted::none));
    EXPECT_FALSE(constants_are_kept(Planted::weighted_sum));
}

TEST(Interpolation, AttributesFollowSnappedPositions) {
    EXPECT_TRUE(follows_snapped_positions(Planted::none));
    EXPECT_FALSE(follows_snapped_positions(Planted::unsnapped_attributes));
}

TEST(Interpolation, VectorsAndFlatValues) {
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
