// ao-oracle and shadow-oracle where the answer is known.
#include "quadrel/relief/trace/oracle/sky.hpp"

#include "relief/oracle/judged.hpp"
#include "relief/planted.hpp"
#include "relief/shadow/lit_batch.hpp"

namespace quadrel::test {
namespace {

using judge::Surface;

/// A point on the floor of a field of walls along v, seen from above: depth 1 per tile.
judge::SkyPoint floor_point(double u) { return {u, 0.5, 0, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}; }

/// Blocks of height 1 over three quarters of a tile: from the middle of the trench, a quarter of a
/// tile wide, the walls stand at tangent 8 in u, and hide all but sin(atan(1/8)) of the sky.
testing::AssertionResult trench_is_as_open(double expected, Planted planted = Planted::none) {
    const JudgedMap map(height_map(8, 8, [](int x, int) { return x < 2 ? 0.0f : 1.0f; }));
    const judge::Sky sky = judge::open_sky(map.field(Surface::block), floor_point(0.125), 4000, 0);
    const double error = planted == Planted::bound_too_small ? sky.error / 100 : sky.error;
    if (std::fabs(sky.open - expected) < 4 * error) return testing::AssertionSuccess();
    return testing::AssertionFailure() << sky.open << " +- " << error;
}

TEST(OpenSky, OfATrenchIsTheFormulas) {
    // Mean of the cosine over directions within atan(1/8) of the trench's plane: 1 / sqrt(1 + 8^2).
    EXPECT_TRUE(trench_is_as_open(1 / std::sqrt(65.0)));
    EXPECT_FALSE(trench_is_as_open(1 / std::sqrt(65.0), Planted::bound_too_small));
    EXPECT_FALSE(trench_is_as_open(0.2));
}

TEST(OpenSky, OfAPlaneIsWhole) {
    const JudgedMap map(flat_map(0.4f, 8));
    for (const Surface surface : surfaces) {
        judge::SkyPoint point = floor_point(0.3);
        point.z = 0.4f;
        const judge::Sky sky = judge::open_sky(map.field(surface), point, 64, 3);
        EXPECT_EQ(sky.open, 1);
        EXPECT_EQ(sky.error, 0);
    }
}

/// Another seed, another estimate, no further off than the errors say; the same seed, the same.
TEST(OpenSky, HasTheErrorThatItStates) {
    Random random(5);
    const JudgedMap map(height_map(12, 12, [&](int, int) { return float(random.uniform(0, 1)); }));
    const judge::Field field = map.field(Surface::bilinear);
    const judge::Sky best = judge::open_sky(field, floor_point(0.4), 20000, 99);
    double squares = 0;
    for (int seed = 0; seed < 100; ++seed) {
        const judge::Sky sky = judge::open_sky(field, floor_point(0.4), 64, seed);
        EXPECT_EQ(sky.open, judge::open_sky(field, floor_point(0.4), 64, seed).open);
        squares += (sky.open - best.open) * (sky.open - best.open) / (sky.error * sky.error);
    }
    EXPECT_GT(best.open, 0.05);
    EXPECT_LT(best.open, 0.95);
    EXPECT_NEAR(squares / 100, 1, 0.5);
}

/// ao-horizon, with many azimuths, is what it estimates.
TEST(OpenSky, IsWhatHorizonsApproximate) {
    const Map map = stress("sinusoid", 4);
    LitBatch lit(map, 2);
    Map horizons;
    BakeOptions many;
    many.parameters["azimuths"] = 32;
    horizons.texture = bake(*map.texture, BakeKind::horizon, map.sampled.sampler, many);
    horizons.sampled = {horizons.texture->view(), map.sampled.sampler};
    lit.batch.bind(TextureSlot::horizon, horizons.sampled);
    lit.batch.run("ao-horizon");
    std::vector<float> expected;
    for (int lane = 0; lane < lit.batch.lanes; ++lane)
        expected.push_back(lit.batch.real(Value::occlusion, lane));
    lit.batch.run("ao-oracle", {{"samples", 256}});
    double mean = 0, off = 0;
    for (int lane = 0; lane < lit.batch.lanes; ++lane) {
        const float open = lit.batch.real(Value::occlusion, lane);
        mean += (open - expected[static_cast<std::size_t>(lane)]) / lit.batch.lanes;
        off += std::fabs(open - expected[static_cast<std::size_t>(lane)]) / lit.batch.lanes;
        EXPECT_LE(lit.batch.real(Value::occlusion_error, lane), 0.5f / std::sqrt(255.0f));
    }
    EXPECT_NEAR(mean, 0, 0.02);
    EXPECT_LT(off, 0.04);
}

/// In worlds of 1e-15 units gradients are 1e15, whose products of four overflow in floats.
TEST(OpenSky, HorizonsHaveNoScale) {
    const Map map = stress("sinusoid", 4);
    LitBatch lit(map, 2);
    Map horizons;
    horizons.texture = bake(*map.texture, BakeKind::horizon, map.sampled.sampler, {});
    horizons.sampled = {horizons.texture->view(), map.sampled.sampler};
    lit.batch.bind(TextureSlot::horizon, horizons.sampled);
    const auto open_at_scale = [&](int power) {
        Batch<float> batch = lit.batch;
        batch.material.depth = std::ldexp(batch.material.depth, power);
        for (int lane = 0; lane < batch.lanes; ++lane)
            for (int c = 0; c < 6; ++c)
                batch.real(Value::J, lane, c) = std::ldexp(batch.real(Value::J, lane, c), -power);
        batch.run("ao-horizon");
        return batch;
    };
    constexpr auto open = values(Value::occlusion);
    Batch<float> ordinary = open_at_scale(0);
    for (const int power : {-60, -40, 40, 60}) {
        Batch<float> scaled = open_at_scale(power);
        EXPECT_TRUE(same_bits<float>(scaled, ordinary, open)) << power;
    }
    EXPECT_FALSE(same_bits<float>(lit.batch, ordinary, open));
}

/// A wall's side is lit from where the view ray came and dark from behind, wherever rounding put
/// the hit; its foot and top are as the formulas have it.
TEST(ShadowOracle, OnBlocksKnowsTheSidesOfWalls) {
    const JudgedMap map(height_map(8, 8, [](int x, int) { return x < 4 ? 0.25f : 0.75f; }));
    const judge::Field field = map.field(Surface::block);
    std::int32_t steps = 0;
    for (const double rounding : {-1e-8, 0.0, 1e-8}) {
        const double wall = 0.5 + rounding;
        EXPECT_FALSE(judge::is_occluded(field, {wall, 0.3, -0.1, 0.05, 0.5}, steps));
        EXPECT_TRUE(judge::is_occluded(field, {wall, 0.3, 0.1, 0.05, 0.5}, steps));
        EXPECT_FALSE(judge::is_occluded(field, {0.7, 0.3, 0.1, 0, 0.75 + rounding}, steps));
    }
    // From the ground at a distance: over the wall where it rises by half on the way.
    EXPECT_TRUE(judge::is_occluded(field, {0.25, 0.3, 0.51, 0, 0.25}, steps));
    EXPECT_FALSE(judge::is_occluded(field, {0.25, 0.3, 0.49, 0, 0.25}, steps));
}

}  // namespace
}  // namespace quadrel::test
