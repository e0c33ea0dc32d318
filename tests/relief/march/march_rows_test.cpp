// Marches where one row must be another: the same samples, counted differently. And what each does
// that no other does.
#include "relief/trace/trace_rows.hpp"

namespace quadrel::test {
namespace {

/// Any map, sampler, seat and angle; |K| up to 5.
struct MarchInputs {
    Random random;
    Map map;
    Batch<float> batch;

    explicit MarchInputs(int seed) : random(static_cast<std::uint64_t>(seed)), batch(64) {
        SamplerState sampler = random_sampler(random);
        sampler.mip = MipFilter::none;
        sampler.min = sampler.mag;  // a level that is given may count as magnified
        map = make_map(
            1 + random.below(40), 1 + random.below(40), 1,
            [&](int, int, int) { return static_cast<float>(random.uniform(-0.05, 1.05)); },
            sampler);
        fill_surface(batch, random, {0.05, 0.25, 1, 0.0005, 0.2});
        batch.material.seat = static_cast<float>(random.uniform(0, 1));
        batch.bind(TextureSlot::height, map.sampled);
    }
};

// ---- Rows that coincide -------------------------------------------------------------------------

/// A row, and the other whose bits it must give.
struct Same {
    std::string id;
    Parameters parameters;
    std::string as;
    Parameters as_parameters;
};

testing::AssertionResult gives_the_bits_of(const Same& same, int maps) {
    for (int i = 0; i < maps; ++i) {
        MarchInputs inputs(i);
        Batch<float> other = inputs.batch;
        inputs.batch.run(same.id, same.parameters);
        other.run(same.as, same.as_parameters);
        const auto result = same_bits<float>(inputs.batch, other, hit_values);
        if (!result) {
            return testing::AssertionFailure()
                   << same.id << " is not " << same.as << ": " << result.message();
        }
    }
    return testing::AssertionSuccess();
}

/// n steps of depth, however they come about.
std::vector<Same> ways_to_march(int n) {
    const double count = n, quality = (n + 0.5) / 50;
    const Parameters steps = {{"steps", count}};
    return {
        {"steep-adaptive", {{"steps_grazing", count}, {"steps_normal", count}}, "linear", steps},
        {"steep-constant-xy", {{"min_steps", count}, {"max_steps", count}}, "linear", steps},
        {"steep-adaptive-rabbid",
         {{"quality_normal", quality}, {"quality_grazing", quality}},
         "linear",
         steps},
        {"steep-mip-c", steps, "linear", steps},
        {"steep-mip-i", steps, "linear", steps},
        {"relief-binary", {{"steps", count}, {"binary_steps", 0}}, "linear", steps},
        {"contact", {{"steps", count}, {"fine_steps", 1}}, "linear", steps},
        {"thesis-linear-binary",
         {{"min_steps", count}, {"max_steps", count}, {"binary_steps", 0}},
         "linear",
         steps},
        {"secant",
         {{"steps", count}, {"iterations", 0}},
         "pom",
         {{"steps_grazing", count}, {"steps_normal", count}}},
        {"interval",
         {{"steps", count}, {"iterations", 5}},
         "secant",
         {{"steps", count}, {"iterations", 5}, {"illinois", 0}}},
    };
}

TEST(MarchRows, TakeTheSamplesOfTheLinearSearch) {
    for (const int n : {1, 7, 16, 49}) {
        for (const Same& same : ways_to_march(n)) EXPECT_TRUE(gives_the_bits_of(same, 15));
    }
    for (int quality = 0; quality < 4; ++quality) {
        const Parameters steps = {{"steps", 16 << quality}};
        EXPECT_TRUE(
            gives_the_bits_of({"steep-quality", {{"quality", quality}}, "linear", steps}, 5));
    }
    // One step more or less is another search.
    for (Same same : ways_to_march(16)) {
        for (auto& [name, value] : same.as_parameters)
            if (name.starts_with("steps")) value += 1;
        EXPECT_FALSE(gives_the_bits_of(same, 15));
    }
}

/// height-outward is `linear` that never tests the bottom plane.
testing::AssertionResult leaves_out_the_bottom(const std::string& id, const Parameters& p) {
    for (int i = 0; i < 20; ++i) {
        MarchInputs inputs(i);
        Batch<float> linear = inputs.batch;
        inputs.batch.run(id, p);
        linear.run("linear", {{"steps", 20}});
        for (int lane = 0; lane < linear.lanes; ++lane) {
            const bool bottom = linear.integer(Value::hit_steps, lane) == 21;
            const bool same =
                inputs.batch.real(Value::hit_s, lane) == linear.real(Value::hit_s, lane);
            const bool floor =
                inputs.batch.integer(Value::hit_status, lane) == static_cast<int>(Status::floor);
            const int steps = inputs.batch.integer(Value::hit_steps, lane);
            if (same && steps == linear.integer(Value::hit_steps, lane) - bottom &&
                floor == bottom) {
                continue;
            }
            return testing::AssertionFailure() << "lane " << lane << ", map " << i;
        }
    }
    return testing::AssertionSuccess();
}

TEST(MarchRows, HeightOutwardLeavesOutTheBottomPlane) {
    EXPECT_TRUE(leaves_out_the_bottom("height-outward", {{"points", 20}}));
    EXPECT_FALSE(leaves_out_the_bottom("linear", {{"steps", 20}}));
}

// ---- Numbers of steps ---------------------------------------------------------------------------

/// Samples that a search takes that finds nothing, over the angle: a field below the bottom plane.
int samples_at(const std::string& id, const Parameters& parameters, float r, dvec2 K) {
    Random random(3);
    const Map map = flat_map(-1);
    Batch<float> batch(16);
    fill_surface(batch, random);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.real(Value::r, lane) = r;
        batch.set(Value::K, lane, K);
    }
    batch.bind(TextureSlot::height, map.sampled);
    batch.run(id, parameters);
    EXPECT_EQ(batch.integer(Value::hit_status, 0), static_cast<int>(Status::floor)) << id;
    EXPECT_EQ(batch.real(Value::hit_s, 0), 1) << id;
    return batch.integer(Value::hit_steps, 0);
}

TEST(MarchRows, NumbersOfStepsAreTheSources) {
    const dvec2 K(0.3, 0.4);  // 1/2 long: cosine 0.894 in texture space
    // ceil(lerp(10, 5, r)) + 1 samples.
    EXPECT_EQ(samples_at("steep", {}, 1, K), 6);
    EXPECT_EQ(samples_at("steep", {}, 0.5f, K), 9);
    EXPECT_EQ(samples_at("steep", {}, 1e-6f, K), 11);
    // trunc(lerp(60, 10, r)) = 47 at 0.25 (47.5), and the other roundings.
    EXPECT_EQ(samples_at("steep-adaptive", {}, 0.25f, K), 48);
    EXPECT_EQ(samples_at("steep-adaptive", {{"rounding", 1}}, 0.25f, K), 49);
    EXPECT_EQ(samples_at("steep-adaptive", {{"rounding", 2}}, 0.25f, K), 49);
    EXPECT_EQ(samples_at("steep-adaptive", {{"steps_normal", 1}, {"steps_grazing", 1}}, 1, K), 2);
    // 50 mix(0.5, 1, 1 - 1 / (1 + |K|^2)) = 50 (0.5 + 0.5 * 0.2) = 30.
    EXPECT_NEAR(samples_at("steep-adaptive-rabbid", {}, 1, dvec2(0.3001, 0.4)), 31, 0);
    EXPECT_EQ(samples_at("steep-adaptive-rabbid", {}, 1, dvec2(0)), 26);
    // ceil(0.5 * 128) = 64.
    EXPECT_EQ(samples_at("steep-constant-xy", {}, 1, K), 65);
    EXPECT_EQ(samples_at("steep-constant-xy", {}, 1, dvec2(0)), 6);
    EXPECT_EQ(samples_at("steep-constant-xy", {{"max_steps", 20}}, 1, K), 21);
    // 4 texels a side: ceil(max(1.2, 1.6)) = 2 steps.
    EXPECT_EQ(samples_at("thesis-linear-binary", {}, 1, K), 3);
    EXPECT_EQ(samples_at("pom", {}, 0.5f, K), 30);
}

/// An unrounded number of steps ends at the bottom plane all the same.
TEST(MarchRows, UnroundedStepsEndAtTheBottom) {
    Random random(5);
    const Map map = flat_map(0);
    Batch<float> batch(16);
    fill_surface(batch, random);
    for (int lane = 0; lane < 16; ++lane) batch.real(Value::r, lane) = 0.25f;
    batch.bind(TextureSlot::height, map.sampled);
    batch.run("steep-adaptive", {{"rounding", 2}});
    EXPECT_EQ(batch.real(Value::hit_s, 3), 1);
    EXPECT_EQ(batch.integer(Value::hit_status, 3), static_cast<int>(Status::hit));
}

// ---- Mip levels ---------------------------------------------------------------------------------

/// The level whose texels the steps sample twice, by the fetches' own account.
struct Levels : StageLog {
    std::vector<float> levels;
    void march_step(const MarchStep&) override {}
    void fetch(const FetchEvent& event) override { levels.push_back(event.lod.level.lane[0]); }
};

std::vector<float> levels_of(const std::string& id, int steps, dvec2 K, int size) {
    Random random(3);
    SamplerState sampler = plain_sampler();
    sampler.mip = MipFilter::linear;
    const Map map = make_map(
        size, size, 1, [](int, int, int) { return 0.5f; }, sampler);
    Batch<float> batch(4);
    fill_surface(batch, random);
    for (int lane = 0; lane < 4; ++lane) batch.set(Value::K, lane, K);
    batch.bind(TextureSlot::height, map.sampled);
    Levels log;
    batch.log = &log;
    batch.run(id, {{"steps", steps}});
    return log.levels;
}

TEST(MarchRows, MipLevelsFollowTheSteps) {
    // 64 texels in 16 steps, two samples per texel: 8 texels of level 0 per texel.
    for (const char* id : {"steep-mip-c", "steep-mip-i"}) {
        EXPECT_EQ(levels_of(id, 16, dvec2(1, -0.5), 64)[0], 3) << id;
        EXPECT_EQ(levels_of(id, 128, dvec2(1, 0), 64)[0], 0) << id;
        EXPECT_EQ(levels_of(id, 200, dvec2(1, 0), 64)[0], 0) << id;
        EXPECT_EQ(levels_of(id, 16, dvec2(0, 0), 64)[0], 0) << id;
        EXPECT_EQ(levels_of(id, 1, dvec2(100, 0), 64)[0], 6) << id;
    }
    EXPECT_EQ(levels_of("steep-mip-i", 16, dvec2(1.4, 0), 64)[0], 4);
    EXPECT_NEAR(levels_of("steep-mip-c", 16, dvec2(1.4142135, 0), 64)[0], 3.5f, 1e-5f);
}

// ---- Refinements --------------------------------------------------------------------------------

/// Halvings do not move a bracket, they halve it: each binary step takes the error to half.
TEST(MarchRows, BisectionHalvesTheStep) {
    for (int i = 0; i < 10; ++i) {
        MarchInputs inputs(i);
        Batch<float> linear = inputs.batch, fine = inputs.batch;
        linear.run("linear", {{"steps", 16}});
        for (int m = 1; m <= 8; ++m) {
            Batch<float> binary = inputs.batch;
            binary.run("relief-binary", {{"steps", 16}, {"binary_steps", m}});
            for (int lane = 0; lane < 64; ++lane) {
                const float s = binary.real(Value::hit_s, lane) * 16;
                const float from = linear.real(Value::hit_s, lane) * 16;
                const float halves = std::ldexp(from - s, m);
                EXPECT_EQ(halves, std::floor(halves));
                EXPECT_TRUE(s <= from && (from == 0 || s > from - 1)) << s << " " << from;
            }
        }
    }
}

/// Each sees the first of three crossings within a step, or the last: heights that cross s = 0.5
/// three times between two samples.
TEST(MarchRows, ContactSeesTheFirstCrossingOfAStep) {
    // Along u: low, a thin wall, low, then high. The ray runs over 8 texels in 2 steps.
    const std::array<float, 8> row = {0, 0, 1, 0, 0, 0, 1, 1};
    const Map map = height_map(8, 1, [&](int x, int) { return row[static_cast<std::size_t>(x)]; });
    Random random(1);
    Batch<float> batch(4);
    fill_surface(batch, random);
    for (int lane = 0; lane < 4; ++lane) {
        batch.set(Value::uv, lane, dvec2(0.0625, 0.5));
        batch.set(Value::K, lane, dvec2(0.875, 0));
    }
    batch.bind(TextureSlot::height, map.sampled);
    Batch<float> contact = batch, binary = batch, chord = batch;
    contact.run("contact", {{"steps", 1}, {"fine_steps", 64}});
    binary.run("relief-binary", {{"steps", 1}, {"binary_steps", 6}});
    // The wall's near side is met at x = 2 - 0.22: s = (1.78 / 7).
    EXPECT_NEAR(contact.real(Value::hit_s, 0), 0.25, 0.03);
    EXPECT_GT(binary.real(Value::hit_s, 0), 0.7);
    chord.run("pom", {{"steps_grazing", 1}, {"steps_normal", 1}});
    EXPECT_NEAR(chord.real(Value::hit_s, 0), 0.5, 1e-6);
}

/// Illinois: curved from one side, where plain regula falsi keeps one end for ever.
TEST(MarchRows, IllinoisConvergesFasterOnCurves) {
    // Steps in height along u make F convex within a march of one step.
    const std::array<float, 8> row = {0, 0, 0, 0, 0.05f, 0.2f, 0.6f, 1};
    const Map map = height_map(
        8, 1, [&](int x, int) { return row[static_cast<std::size_t>(x)]; }, Wrap::clamp_to_edge);
    Random random(1);
    Batch<float> batch(4);
    fill_surface(batch, random);
    for (int lane = 0; lane < 4; ++lane) {
        batch.set(Value::uv, lane, dvec2(0.0625, 0.5));
        batch.set(Value::K, lane, dvec2(0.875, 0));
    }
    batch.bind(TextureSlot::height, map.sampled);
    Batch<float> truth = batch, illinois = batch, plain = batch;
    truth.run("linear", {{"steps", 60000}});
    illinois.run("secant", {{"steps", 1}, {"iterations", 6}});
    plain.run("interval", {{"steps", 1}, {"iterations", 6}});
    const auto error = [&](Batch<float>& b) {
        return std::abs(b.real(Value::hit_s, 0) - truth.real(Value::hit_s, 0));
    };
    EXPECT_LT(error(illinois), 2e-4f);
    EXPECT_GE(error(plain), error(illinois));
}

// ---- The thesis' searches -----------------------------------------------------------------------

/// Nearest texels say hit where the interpolated surface is still below the ray.
TEST(MarchRows, LiteralLinearBinaryLosesItsCrossing) {
    const Map map = height_map(16, 16, [](int x, int) { return x % 4 == 2 ? 0.75f : 0.0f; });
    Random random(2);
    Batch<float> batch;
    fill_surface(batch, random, {0.2});
    batch.bind(TextureSlot::height, map.sampled);
    batch.run("thesis-linear-binary@published");
    int lost = 0, found = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const auto status = static_cast<Status>(batch.integer(Value::hit_status, lane));
        lost += status == Status::cap;
        found += status == Status::hit;
        EXPECT_NE(status, Status::nan);
    }
    EXPECT_GT(lost, 5);
    EXPECT_GT(found, 20);
}

/// The sphere's first step is the whole gap straight down, and that times r otherwise.
TEST(MarchRows, SphereStepsByTheVerticalGap) {
    struct Steps : StageLog {
        std::vector<float> s;
        void march_step(const MarchStep& step) override { s.push_back(step.s.lane[0]); }
        void fetch(const FetchEvent&) override {}
    };
    Random random(2);
    const Map map = flat_map(0.25f);
    Batch<float> batch(4);
    fill_surface(batch, random);
    for (int lane = 0; lane < 4; ++lane) batch.real(Value::r, lane) = 0.5f;
    batch.bind(TextureSlot::height, map.sampled);
    Steps log;
    batch.log = &log;
    batch.run("thesis-sphere");
    ASSERT_GE(log.s.size(), 4u);
    EXPECT_EQ(log.s[1], 0.375f);
    EXPECT_EQ(log.s[2], 0.5625f);
    EXPECT_EQ(log.s[3], 0.65625f);
    // 0.75 / 2^k <= 1/1024 at k = 10.
    EXPECT_EQ(batch.integer(Value::hit_steps, 0), 11);
    batch.log = nullptr;
    batch.run("thesis-sphere", {{"steps", 5}});
    EXPECT_EQ(batch.integer(Value::hit_status, 0), static_cast<int>(Status::cap));
}

}  // namespace
}  // namespace quadrel::test
