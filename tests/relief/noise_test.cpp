// Noise in place of a height map: range, tiling, gradient, and the stages that read it.
#include "quadrel/relief/noise.hpp"

#include "relief/facet.hpp"
#include "relief/planted.hpp"
#include "relief/stage_inputs.hpp"

namespace quadrel::test {
namespace {

using Field = std::function<NoiseSample<double>(const dvec2&)>;

/// The field of a frequency and octaves, or one with an error.
Field field(float frequency, int octaves, Planted planted = Planted::none) {
    return [=](const dvec2& at) {
        dvec2 uv = at;
        if (planted == Planted::lattice_does_not_wrap) uv += dvec2(std::floor(at.x) * 64.3, 0);
        auto sample = noise_field<double>(uv, frequency, octaves);
        if (planted == Planted::gain_of_two) sample.gradient *= 2;
        if (planted == Planted::axes_exchanged) std::swap(sample.gradient.x, sample.gradient.y);
        if (planted == Planted::noise_around_zero) sample.value -= 0.5;
        return sample;
    };
}

dvec2 random_uv(Random& random) { return {random.uniform(-3, 3), random.uniform(-3, 3)}; }

// ---- The field ----------------------------------------------------------------------------------

/// In [0, 1], on both sides of 1/2, and of use: at least a half of the range is seen.
testing::AssertionResult fills_its_range(const Field& noise) {
    Random random(1);
    double low = 1, high = 0;
    for (int i = 0; i < 20000; ++i) {
        const double h = noise(random_uv(random)).value;
        if (!(h >= 0 && h <= 1)) return testing::AssertionFailure() << h;
        low = std::min(low, h);
        high = std::max(high, h);
    }
    return low < 0.3 && high > 0.7 ? testing::AssertionSuccess()
                                   : testing::AssertionFailure() << low << " to " << high;
}

TEST(Noise, FillsItsRange) {
    for (const int octaves : {1, 2, 4, 10}) EXPECT_TRUE(fills_its_range(field(5, octaves)));
    EXPECT_FALSE(fills_its_range(field(5, 1, Planted::noise_around_zero)));
}

/// The same values and gradients a tile further. (Exactly the same lattice; the position rounds.)
testing::AssertionResult tiles(const Field& noise) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const dvec2 uv = random_uv(random);
        const dvec2 further = uv + dvec2(random.below(7) - 3, random.below(7) - 3);
        const auto a = noise(uv), b = noise(further);
        if (!(std::abs(a.value - b.value) < 1e-11 && length(a.gradient - b.gradient) < 1e-8))
            return testing::AssertionFailure() << a.value << " and " << b.value;
    }
    return testing::AssertionSuccess();
}

TEST(Noise, TilesWhereTheFrequencyIsWhole) {
    EXPECT_TRUE(tiles(field(1, 4)));
    EXPECT_TRUE(tiles(field(7, 5)));
    EXPECT_TRUE(tiles(field(96, 2)));
    EXPECT_FALSE(tiles(field(7.5f, 5)));
    EXPECT_FALSE(tiles(field(7, 5, Planted::lattice_does_not_wrap)));
}

/// The gradient is the limit of differences, across cell borders as well.
testing::AssertionResult gradient_is_the_slope(const Field& noise) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        dvec2 uv = random_uv(random);
        if (i % 4 == 0) uv.x = std::round(uv.x * 6) / 6;  // on a border
        const double e = 1e-6;
        const dvec2 slope(
            (noise(uv + dvec2(e, 0)).value - noise(uv - dvec2(e, 0)).value) / (2 * e),
            (noise(uv + dvec2(0, e)).value - noise(uv - dvec2(0, e)).value) / (2 * e));
        const double error = length(slope - noise(uv).gradient);
        if (!(error < 1e-6)) return testing::AssertionFailure() << "off by " << error;
    }
    return testing::AssertionSuccess();
}

TEST(Noise, GradientIsTheSlope) {
    EXPECT_TRUE(gradient_is_the_slope(field(6, 1)));
    EXPECT_TRUE(gradient_is_the_slope(field(3.7f, 4)));
    EXPECT_FALSE(gradient_is_the_slope(field(6, 1, Planted::gain_of_two)));
    EXPECT_FALSE(gradient_is_the_slope(field(6, 1, Planted::axes_exchanged)));
}

TEST(Noise, IsHalfOnThePointsOfItsLattice) {
    for (int x = -3; x < 3; ++x)
        for (int y = -3; y < 3; ++y) {
            EXPECT_EQ(lattice_noise<float>({float(x), float(y)}, 0, 5).value, 0);
            EXPECT_EQ(noise_field<float>({x / 4.0f, y / 4.0f}, 4, 3).value, 0.5f);
        }
}

/// Special points: far away a float has no fraction, and what is not a number stays so.
TEST(Noise, FarAwayAndNotANumber) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    EXPECT_EQ(noise_field<float>({0x1p25f, -0x1p25f}, 4, 3).value, 0.5f);
    for (const float bad : {inf, -inf, nan}) {
        const float h = noise_field<float>({bad, 0.3f}, 4, 3).value;
        EXPECT_NE(h, h);
    }
}

/// Lanes of a quad are plain floats, bit for bit; double is near.
TEST(Noise, EveryNumberTypeGivesTheSame) {
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        vec2<Quad<float>> uv;
        for (int c = 0; c < 2; ++c)
            for (float& x : uv[c].lane) x = static_cast<float>(random.uniform(-2, 2));
        const auto quad = noise_field(uv, 6, 3);
        for (int lane = 0; lane < 4; ++lane) {
            const vec2<float> one(uv.x.lane[lane], uv.y.lane[lane]);
            const auto plain = noise_field(one, 6, 3);
            const auto wide = noise_field(dvec2(one), 6, 3);
            EXPECT_EQ(plain.value, quad.value.lane[lane]);
            EXPECT_EQ(plain.gradient.x, quad.gradient.x.lane[lane]);
            EXPECT_NEAR(plain.value, wide.value, 1e-5);
            EXPECT_NEAR(plain.gradient.y, wide.gradient.y, 1e-3);
        }
    }
}

// ---- Stages -------------------------------------------------------------------------------------

/// A march over noise: the hit is where a loop over plain numbers finds it, a fetch a step.
testing::AssertionResult march_meets_the_noise(float frequency) {
    StageInputs inputs(5, SlotsBound::not_baked);
    Batch<float>& batch = inputs.batch;
    batch.material.noise_octaves = 3;
    batch.material.noise_frequency = 5;
    batch.unbind(TextureSlot::height);
    batch.counters = {};
    batch.run("linear", {{"steps", 64}});
    std::uint64_t steps = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const vec2<float> uv = batch.vector2(Value::uv, lane), K = batch.vector2(Value::K, lane);
        int k = 0;
        for (; k < 64; ++k) {
            const float s = static_cast<float>(k) / 64;
            const vec2<float> at = uv + K * (s - (1 - batch.material.seat));
            if (noise_field(at, frequency, 3).value >= 1 - s) break;
        }
        steps += static_cast<std::uint64_t>(batch.integer(Value::hit_steps, lane));
        if (batch.integer(Value::frame_status, lane) != static_cast<int>(Status::hit)) continue;
        if (batch.real(Value::hit_s, lane) != static_cast<float>(k) / 64)
            return testing::AssertionFailure() << "lane " << lane << ": " << k;
    }
    const std::uint64_t counted = batch.counters[static_cast<int>(TextureSlot::height)].fetches;
    return counted == steps ? testing::AssertionSuccess()
                            : testing::AssertionFailure() << counted << " fetches";
}

TEST(NoiseHeights, MarchesMeetThem) {
    EXPECT_TRUE(march_meets_the_noise(5));
    EXPECT_FALSE(march_meets_the_noise(6));
}

/// h2n-patch over noise: the normal of the gradient, without a texture.
TEST(NoiseHeights, ThePatchIsTheGradient) {
    Random random(6);
    const Plane plane = random_plane(random);
    Batch<float> batch = facet_batch(plane, leaning(plane, random, 0.3), 0.1f, random);
    batch.material.noise_octaves = 2;
    batch.material.noise_frequency = 3;
    batch.run("h2n-patch");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec2 uv(batch.vector2(Value::hit_uv, lane));
        const dvec2 slope = noise_field(uv, 3, 2).gradient;
        const dvec3 gu(batch.vector3(Value::J, lane)), gv(batch.vector3(Value::J, lane, 3));
        const dvec3 n = normalize(dvec3(batch.vector3(Value::frame_normal, lane)) -
                                  (gu * slope.x + gv * slope.y) * double(0.1f));
        EXPECT_LT(length(dvec3(batch.vector3(Value::N, lane)) - n), 1e-5);
    }
}

/// Over noise, no stage that accepts it reads the height map. (`all`: those that do not, too.)
testing::AssertionResult the_map_has_no_effect(bool all) {
    Random random(7);
    const Map another = random_map(random, 1);
    for (const StageInfo& stage : all_stages()) {
        const auto end = stage.textures.end();
        const bool reads =
            std::find(stage.textures.begin(), end, TextureSlot::height) != end &&
            std::find_if(stage.textures.begin(), end,
                         [](TextureSlot s) { return s >= first_baked_slot; }) == end &&
            stage.text.room != std::string_view("quad");
        if (!reads || (stage.needs_height_map && !all)) continue;
        StageInputs inputs(8);
        inputs.batch.material.noise_octaves = 2;
        inputs.batch.material.noise_frequency = 4;
        Batch<float> other = inputs.batch;
        other.bind(TextureSlot::height, another.sampled);
        inputs.batch.run(stage.text.id);
        other.run(stage.text.id);
        const auto result = same_bits<float>(inputs.batch, other, stage.outputs);
        if (!result)
            return testing::AssertionFailure() << stage.text.id << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

TEST(NoiseHeights, StagesThatTakeThemLeaveTheMapAlone) {
    EXPECT_TRUE(the_map_has_no_effect(false));
    EXPECT_FALSE(the_map_has_no_effect(true));
}

}  // namespace
}  // namespace quadrel::test
