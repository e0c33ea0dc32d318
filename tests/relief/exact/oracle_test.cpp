// The oracle itself: against marches, against rational arithmetic, and against what must hold for
// any judge of height fields.
#include "relief/exact/oracle_exact.hpp"

#include "relief/exact/exact_search.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using oracle::Field;
using oracle::Hit;
using oracle::Ray;
using oracle::Real;

using Meet = std::function<Hit(const Field&, const Ray&)>;

/// The bilinear oracle, or one with an error planted.
Meet bilinear(Planted planted = Planted::none) {
    return [planted](const Field& field, const Ray& ray) {
        Hit hit = oracle::meet_bilinear(field, ray);
        // A patch further on, as if the first root had not been looked at.
        if (planted == Planted::later_root && hit.found) hit.s = std::min<Real>(1, hit.s + 0.02L);
        if (planted == Planted::one_sample_early) hit.s = std::max<Real>(0, hit.s - 0.001L);
        return hit;
    };
}

/// `check(field, ray)` on random rays over every kind of map, those along borders and through
/// corners among them.
template <class Check>
testing::AssertionResult on_rays(int rays_a_map, const Check& check) {
    for (const StressMap& kind : stress_maps()) {
        Random random(11);
        SamplerState sampler = plain_sampler(static_cast<Wrap>(random.below(5)));
        const Map map =
            make_stress_map(kind, 8 + random.below(30), 8 + random.below(30), sampler, random);
        const Field field(map.sampled);
        Batch<float> rays;
        fill_stress_rays(rays, map, random);
        for (int lane = 0; lane < rays_a_map; ++lane) {
            const auto result = check(field, oracle_ray(rays, lane));
            if (!result)
                return testing::AssertionFailure()
                       << kind.name << ", ray " << lane << ": " << result.message();
        }
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult same_s(Real a, Real b, Real tolerance) {
    if (std::fabs(a - b) <= tolerance) return testing::AssertionSuccess();
    return testing::AssertionFailure() << double(a) << " and " << double(b);
}

/// 1/20000 steps meet nothing before the oracle does, and it meets nothing where they see none.
testing::AssertionResult is_first(const Meet& meet) {
    return on_rays(8, [&](const Field& field, const Ray& ray) {
        const Hit hit = meet(field, ray), marched = oracle::march(field, ray, 20000);
        if (marched.s < hit.s - 1e-12L)
            return testing::AssertionFailure()
                   << "a sample at " << double(marched.s) << " is below, before " << double(hit.s);
        return testing::AssertionSuccess();
    });
}

/// The point that it names is on the surface, or the ray starts below.
testing::AssertionResult is_on_the_surface(const Meet& meet) {
    return on_rays(64, [&](const Field& field, const Ray& ray) {
        const oracle::GridRay grid(field, ray, 0.5L);
        const Real s = meet(field, ray).s;
        const Real above = 1 - s - field.bilinear(grid.x + grid.dx * s, grid.y + grid.dy * s);
        const bool starts_below = s == 0 && above < 0;
        if (starts_below || std::fabs(above) < 1e-12L) return testing::AssertionSuccess();
        return testing::AssertionFailure() << double(above) << " above at " << double(s);
    });
}

TEST(Oracle, NamesTheFirstPointOfTheSurface) {
    EXPECT_TRUE(is_first(bilinear()));
    EXPECT_FALSE(is_first(bilinear(Planted::later_root)));
    EXPECT_TRUE(is_on_the_surface(bilinear()));
    EXPECT_FALSE(is_on_the_surface(bilinear(Planted::one_sample_early)));
}

/// Rational arithmetic decides the same, where rounding could not decide otherwise.
testing::AssertionResult agrees_with_rationals(const Meet& meet) {
    return on_rays(24, [&](const Field& field, const Ray& ray) {
        return same_s(meet(field, ray).s, oracle::meet_bilinear_exactly(field, ray).s, 1e-9L);
    });
}

TEST(Oracle, AgreesWithRationals) {
    EXPECT_TRUE(agrees_with_rationals(oracle::decide_bilinear));
    EXPECT_FALSE(agrees_with_rationals(bilinear(Planted::later_root)));
}

/// Rays that touch a ridge exactly, which only rational arithmetic can be relied on to tell from
/// rays that pass by one roundoff above it.
TEST(Oracle, DecidesGrazes) {
    // A ridge of height 3/4 along x = 4 between valleys of height 1/4.
    const Map map = height_map(9, 9, [](int x, int) { return x == 4 ? 0.75f : 0.25f; });
    const Field field(map.sampled);
    // Slope of the flanks 1/2 per cell; a ray with K = 2 cells over the depth falls as steeply.
    const float K = 2.0f / 9;
    const Real through = 0.25L, u = (Real(4) + 0.5L) / 9 - through * K;
    EXPECT_LE(oracle::meet_bilinear_exactly(field, {u, 0.5L, K, 0}).s, through + 1e-12L);
    const Real above = u + 0x1p-40L;
    EXPECT_GT(oracle::meet_bilinear_exactly(field, {above, 0.5L, K, 0}).s, through);
}

/// Blocks, patches and triangles are one surface where the map is constant.
testing::AssertionResult readings_agree_on_constant_maps(Real height) {
    const Map map = flat_map(static_cast<float>(height), 7);
    const Field field(map.sampled);
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const vec2<float> K = random_shift(random);
        const Ray ray{Real(random.uniform(-2, 2)), Real(random.uniform(-2, 2)), K.x, K.y};
        const Real expected = 1 - field.texel(0, 0);
        for (const Hit& hit : {oracle::meet_bilinear(field, ray), oracle::meet_blocks(field, ray),
                               oracle::meet_triangles(field, ray, oracle::Diagonal::main),
                               oracle::meet_triangles(field, ray, oracle::Diagonal::anti),
                               oracle::meet_triangles(field, ray, oracle::Diagonal::least)}) {
            const auto result = same_s(hit.s, expected, 1e-15L);
            if (!result) return result;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Oracle, ReadingsAgreeOnConstantMaps) {
    for (const Real height : {0.0L, 0.3L, 0.5L, 1.0L})
        EXPECT_TRUE(readings_agree_on_constant_maps(height));
}

/// Triangles equal patches where every cell is planar, and differ elsewhere.
TEST(Oracle, TrianglesArePatchesOnPlanarCells) {
    const Map planar = height_map(
        12, 12, [](int x, int y) { return x % 8 / 16.0f + y % 4 / 8.0f; }, Wrap::clamp_to_edge);
    const Map saddles = height_map(12, 12, [](int x, int y) { return (x + y) % 2 / 1.0f; });
    Random random(4);
    int differ = 0;
    for (int i = 0; i < 300; ++i) {
        const vec2<float> K = random_shift(random);
        const Ray ray{Real(random.uniform(0, 1)), Real(random.uniform(0, 1)), K.x / 4, K.y / 4};
        for (const auto diagonal : {oracle::Diagonal::main, oracle::Diagonal::anti}) {
            const Field flat(planar.sampled), bent(saddles.sampled);
            EXPECT_TRUE(same_s(oracle::meet_triangles(flat, ray, diagonal).s,
                               oracle::meet_bilinear(flat, ray).s, 1e-14L));
            differ += !same_s(oracle::meet_triangles(bent, ray, diagonal).s,
                              oracle::meet_bilinear(bent, ray).s, 1e-4L);
        }
    }
    EXPECT_GT(differ, 100);
}

/// The map and the ray mirrored in u give the same s.
testing::AssertionResult is_symmetric(const Meet& meet, const Meet& mirrored) {
    for (const StressMap& kind : stress_maps()) {
        Random random(5);
        const Map map = make_stress_map(kind, 13, 10, plain_sampler(), random);
        const Map other = height_map(13, 10, [&](int x, int y) {
            return static_cast<float>(Field(map.sampled).texel(12 - x, y));
        });
        for (int i = 0; i < 20; ++i) {
            const vec2<float> K = random_shift(random);
            const Real u = random.uniform(0, 1), v = random.uniform(0, 1);
            const auto result =
                same_s(meet(Field(map.sampled), {u, v, K.x, K.y}).s,
                       mirrored(Field(other.sampled), {1 - u, v, -K.x, K.y}).s, 1e-12L);
            if (!result) return testing::AssertionFailure() << kind.name << result.message();
        }
    }
    return testing::AssertionSuccess();
}

TEST(Oracle, IsSymmetric) {
    EXPECT_TRUE(is_symmetric(bilinear(), bilinear()));
    EXPECT_TRUE(
        is_symmetric([](const Field& f, const Ray& r) { return oracle::meet_blocks(f, r); },
                     [](const Field& f, const Ray& r) { return oracle::meet_blocks(f, r); }));
    EXPECT_FALSE(is_symmetric(bilinear(), bilinear(Planted::one_sample_early)));
}

/// Higher heights are met no later.
testing::AssertionResult is_monotonic(Real lift) {
    return on_rays(32, [&](const Field& field, const Ray& ray) {
        for (const bool blocks : {false, true}) {
            const auto meet = [&](Real by) {
                return blocks ? oracle::meet_blocks(field, ray, by).s
                              : oracle::meet_bilinear(field, ray, by).s;
            };
            if (meet(lift) > meet(0))
                return testing::AssertionFailure() << (blocks ? "blocks" : "patches");
        }
        return testing::AssertionSuccess();
    });
}

TEST(Oracle, IsMonotonicInTheHeights) {
    EXPECT_TRUE(is_monotonic(0.01L));
    EXPECT_TRUE(is_monotonic(0.3L));
    EXPECT_FALSE(is_monotonic(-0.01L));
}

}  // namespace
}  // namespace quadrel::test
