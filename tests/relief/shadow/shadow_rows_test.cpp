// Self-shadows: what all of them promise.
#include "relief/shadow/lit_batch.hpp"

namespace quadrel::test {
namespace {

const std::vector<std::string> shadows = {"shadow-march-mcguire",
                                          "shadow-march-mcguire@published",
                                          "shadow-relief",
                                          "shadow-soft-pom",
                                          "shadow-soft-riccardi",
                                          "shadow-cone",
                                          "shadow-exact",
                                          "shadow-oracle",
                                          "horizon",
                                          "shadow-march-thesis"};

// ---- What all promise ---------------------------------------------------------------------------

/// Every lane of a batch is lit.
testing::AssertionResult all_lit(LitBatch& lit, const StageUnderTest<float>& shadow) {
    shadow.run(lit.batch);
    for (int lane = 0; lane < lit.batch.lanes; ++lane)
        if (lit.visibility(lane) != 1)
            return testing::AssertionFailure() << shadow.id << ": " << lit.visibility(lane);
    return testing::AssertionSuccess();
}

TEST(Shadows, NothingShadowsAPlane) {
    const Map flat = flat_map(0.4f, 16);
    for (const std::string& id : shadows)
        for (int seed = 0; seed < 4; ++seed) {
            LitBatch lit(flat, seed);
            EXPECT_TRUE(all_lit(lit, {id}));
        }
    LitBatch lit(flat, 0);
    const auto darken = [](Batch<float>& b) { b.real(Value::shadow_visibility, 7) = 0; };
    EXPECT_FALSE(all_lit(lit, {"shadow-relief", {}, darken}));
}

TEST(Shadows, ALightBehindTheSurfaceIsDark) {
    const Map map = stress("sinusoid", 1);
    for (const std::string& id : shadows) {
        LitBatch lit(map, 2);
        lit.light(1.0, -0.3);
        lit.batch.run(id);
        for (int lane = 0; lane < lit.batch.lanes; ++lane) EXPECT_EQ(lit.visibility(lane), 0) << id;
    }
}

TEST(Shadows, AnOverheadLightReachesEverything) {
    const Map map = stress("sinusoid", 1);
    for (const std::string& id : shadows) {
        LitBatch lit(map, 3);
        lit.light(0, 1.5707963267948966);
        EXPECT_TRUE(all_lit(lit, {id}));
    }
}

/// Hard shadows agree with a fine march wherever it is plain: what rises well above the ray, some
/// way off, is dark; a ray that stays well above everything is lit.
int disagreements(const StageUnderTest<float>& shadow, const Parameters& parameters) {
    int wrong = 0;
    for (int seed = 0; seed < 6; ++seed) {
        const Map map = stress(seed % 2 == 0 ? "fractal" : "checker of 8", seed);
        LitBatch lit(map, seed);
        lit.light(seed, 0.15 + 0.05 * seed);
        // Before the run: a planted error may change what the rays are made from.
        std::vector<bool> dark, clear;
        for (int lane = 0; lane < lit.batch.lanes; lane += 5) {
            dark.push_back(lit.most_excess(lane, 0.2) > 0.08);
            clear.push_back(lit.most_excess(lane, 0.02) < -0.02);
        }
        shadow.run(lit.batch, parameters);
        for (std::size_t i = 0; i < dark.size(); ++i) {
            const float visibility = lit.visibility(static_cast<int>(5 * i));
            wrong += (dark[i] && visibility != 0) || (clear[i] && visibility != 1);
        }
    }
    return wrong;
}

TEST(Shadows, HardOnesAreWhereTheyBelong) {
    EXPECT_LE(disagreements({"shadow-march-mcguire"}, {{"steps_normal", 64}}), 3);
    EXPECT_LE(disagreements({"shadow-relief"}, {{"steps", 64}}), 3);
    EXPECT_LE(disagreements({"shadow-cone"}, {{"steps", 400}}), 3);
    EXPECT_LE(disagreements({"shadow-march-thesis"}, {}), 3);
    EXPECT_EQ(disagreements({"shadow-exact"}, {}), 0);
    EXPECT_EQ(disagreements({"shadow-oracle"}, {}), 0);
    const auto mirror = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane)
            for (int c = 0; c < 6; ++c) b.real(Value::J, lane, c) *= -1;
    };
    EXPECT_GT(disagreements({"shadow-relief", mirror}, {{"steps", 64}}), 10);
}

/// Towards stored azimuths, from texel centres, a horizon decides as a fine march does.
testing::AssertionResult horizon_is_exact(const StageUnderTest<float>& shadow) {
    int decided = 0;
    for (int seed = 0; seed < 8; ++seed) {
        const Map map = stress("fractal", seed);
        LitBatch lit(map, seed);
        lit.light(seed * 0.78539816339744831, 0.05 + 0.05 * seed);
        for (int lane = 0; lane < lit.batch.lanes; ++lane) {
            const vec2<float> uv = lit.batch.vector2(Value::hit_uv, lane);
            const vec2<float> centre = (floor(uv * 32.0f) + 0.5f) / 32.0f;
            const oracle::Field field(map.sampled);
            lit.batch.set(Value::hit_uv, lane, centre);
            const float h =
                static_cast<float>(field.bilinear(centre.x * 32 - 0.5, centre.y * 32 - 0.5));
            lit.batch.real(Value::hit_s, lane) = 1 - h;
            lit.batch.real(Value::hit_h, lane) = h;
        }
        std::vector<double> excess;
        for (int lane = 0; lane < lit.batch.lanes; lane += 2)
            excess.push_back(lit.most_excess(lane, 1e-3));
        shadow.run(lit.batch);
        for (std::size_t i = 0; i < excess.size(); ++i) {
            if (std::abs(excess[i]) < 1e-3) continue;
            ++decided;
            const float visibility = lit.visibility(static_cast<int>(2 * i));
            if ((excess[i] > 0) != (visibility == 0))
                return testing::AssertionFailure()
                       << "excess " << excess[i] << " is " << visibility << ", seed " << seed;
        }
    }
    return decided > 100 ? testing::AssertionSuccess() : testing::AssertionFailure() << decided;
}

TEST(Shadows, HorizonsAreExactAtTexelCentres) {
    EXPECT_TRUE(horizon_is_exact({"horizon"}));
    const auto turn = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane)
            for (int c = 0; c < 3; ++c) b.real(Value::J, lane, c) *= -1;
    };
    EXPECT_FALSE(horizon_is_exact({"horizon", turn}));
}

/// Softer with distance: visibility is within [0, 1] and takes values between.
TEST(Shadows, SoftOnesHavePenumbras) {
    for (const char* id : {"shadow-soft-pom", "shadow-soft-riccardi"}) {
        int between = 0;
        for (int seed = 0; seed < 4; ++seed) {
            const Map map = stress("sinusoid", seed);
            LitBatch lit(map, seed, 0.1);
            lit.light(seed, 0.2);
            lit.batch.run(id);
            for (int lane = 0; lane < lit.batch.lanes; ++lane) {
                EXPECT_GE(lit.visibility(lane), 0);
                EXPECT_LE(lit.visibility(lane), 1);
                between += lit.visibility(lane) > 0 && lit.visibility(lane) < 1;
            }
        }
        EXPECT_GT(between, 20) << id;
    }
}

TEST(Shadows, SoftHorizonsFade) {
    const Map map = stress("sinusoid", 5);
    LitBatch lit(map, 5);
    lit.light(0.3, 0.15);
    lit.batch.run("horizon", {{"softness", 1}});
    int between = 0;
    for (int lane = 0; lane < lit.batch.lanes; ++lane)
        between += lit.visibility(lane) > 0 && lit.visibility(lane) < 1;
    EXPECT_GT(between, 20);
}

// ---- Ambient occlusion --------------------------------------------------------------------------

TEST(AmbientOcclusion, APlaneIsOpenAndAPitIsNot) {
    const Map flat = flat_map(0.4f, 16), spikes = stress("wall x", 4);
    LitBatch open(flat, 1), closed(spikes, 1);
    open.batch.run("ao-horizon");
    closed.batch.material.depth = 0.4f;
    closed.batch.run("ao-horizon");
    double sum = 0;
    for (int lane = 0; lane < open.batch.lanes; ++lane) {
        EXPECT_EQ(open.batch.real(Value::occlusion, lane), 1);
        const float o = closed.batch.real(Value::occlusion, lane);
        EXPECT_GE(o, 0);
        EXPECT_LE(o, 1);
        sum += o;
    }
    EXPECT_LT(sum / closed.batch.lanes, 0.9);
}

}  // namespace
}  // namespace quadrel::test
