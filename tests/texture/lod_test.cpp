// Level of detail: the scale factor's forms, rounding, clamps.
#include "quadrel/texture/lod.hpp"

#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using Float = Quad<float>;
using Double = Quad<double>;

/// rho, lambda, level and frac of one lane, for gradients in texels of level 0.
struct Lod {
    double rho, lambda, level, frac;
    bool magnified;
};
using LodFunction = std::function<Lod(const SampledTexture&, vec2<double> dx, vec2<double> dy)>;

template <class F>
Lod real_lod(const SampledTexture& t, vec2<double> dx, vec2<double> dy) {
    using S = Scalar<F>;
    const double w = t.view.width[0], h = t.view.height[0];
    const auto lanes = [](double x) { return F(static_cast<S>(x)); };
    const LodRecord<F> record = compute_lod(t, vec2<F>(lanes(dx.x / w), lanes(dx.y / h)),
                                            vec2<F>(lanes(dy.x / w), lanes(dy.y / h)));
    return {first_lane(record.rho), first_lane(record.lambda), first_lane(record.level),
            first_lane(record.frac), record.magnified.lane[0]};
}

struct Expected {
    LodForm form;
    vec2<double> dx, dy;
    double lambda;
};
const Expected expected_lods[] = {
    {LodForm::sqrt_max, {3, 4}, {0, 0}, 2.321928094887362},
    {LodForm::sqrt_max, {4, 0}, {4, 1}, 2.0437314206251695},
    {LodForm::ellipse, {4, 0}, {4, 1}, 2.5113572442190146},
    {LodForm::ellipse, {3, 4}, {0, 0}, 2.321928094887362},
    {LodForm::ellipse, {3, 4}, {6, 8}, 3.321928094887362},  // parallel: no ellipse
    {LodForm::sqrt_max, {8, 0}, {0, 1}, 3},
    {LodForm::linear_log2, {3, 0}, {0, 1}, 0.5 * (3 + 1.0 / 8)},
    {LodForm::quartic_log2, {3, 0}, {0, 1}, 0.25 * (6 + 17.0 / 64)},
};

testing::AssertionResult gives_expected(const LodFunction& lod, double tolerance) {
    RandomTexture texture(64, 16, 1);
    for (const Expected& e : expected_lods) {
        texture.sampled.sampler.lod_form = e.form;
        const Lod got = lod(texture.sampled, e.dx, e.dy);
        if (std::fabs(got.lambda - e.lambda) <= tolerance) continue;
        return testing::AssertionFailure() << got.lambda << ", want " << e.lambda;
    }
    return testing::AssertionSuccess();
}

TEST(Lod, Expected) {
    EXPECT_TRUE(gives_expected(real_lod<Double>, 1e-14));
    EXPECT_TRUE(gives_expected(real_lod<Float>, 1e-6));
    EXPECT_FALSE(gives_expected(  // Planted::smaller_gradient
        [](const SampledTexture& t, vec2<double> dx, vec2<double> dy) {
            const bool swap = glm::dot(dx, dx) > glm::dot(dy, dy);
            return real_lod<Double>(t, swap ? dy : dx, swap ? dy : dx);
        },
        1e-6));
    EXPECT_FALSE(gives_expected(  // Planted::rho_of_each_level
        [](const SampledTexture& t, vec2<double> dx, vec2<double> dy) {
            return real_lod<Double>(t, dx / 2.0, dy / 2.0);
        },
        1e-6));
}

TEST(Lod, PowersOfTwoAreExact) {
    RandomTexture texture(1024, 1024, 1);
    for (int power = -8; power <= 12; ++power) {
        const double length = std::ldexp(1.0, power);
        const Lod lod = real_lod<Float>(texture.sampled, {length, 0}, {0, length / 2});
        EXPECT_EQ(lod.rho, length);
        EXPECT_EQ(lod.lambda, power);
        EXPECT_EQ(lod.level, std::min(std::max(power, 0), 10));
        EXPECT_EQ(lod.frac, 0);
        EXPECT_EQ(lod.magnified, power <= 0);
    }
}

/// The largest errors of the approximate forms over an octave are the published ones.
TEST(Lod, ApproximationsErrAsDocumented) {
    RandomTexture texture(64, 64, 1);
    const auto largest_error = [&](LodForm form) {
        texture.sampled.sampler.lod_form = form;
        double largest = 0;
        for (int i = 0; i < 4096; ++i) {
            const double rho = 1 + i / 4096.0;
            const double got = real_lod<Double>(texture.sampled, {rho, 0}, {0, 0}).lambda;
            largest = std::max(largest, std::fabs(got - std::log2(rho)));
        }
        return largest;
    };
    EXPECT_LT(largest_error(LodForm::sqrt_max), 1e-14);
    EXPECT_NEAR(largest_error(LodForm::linear_log2), 0.0430357, 1e-6);
    EXPECT_NEAR(largest_error(LodForm::quartic_log2), 0.0215178, 1e-6);
}

using LevelFunction = std::function<Lod(const SampledTexture&, double lod)>;

Lod level_for(const SampledTexture& t, double lod) {
    const LodRecord<Double> record = lod_from_level(t, Double(lod));
    return {0, first_lane(record.lambda), first_lane(record.level), first_lane(record.frac),
            record.magnified.lane[0]};
}

testing::AssertionResult prefers_finer_at_half(const LevelFunction& select) {
    RandomTexture texture(64, 64, 1);
    texture.sampled.sampler.mip = MipFilter::nearest;
    for (int level = 0; level < 3; ++level) {
        const double got = select(texture.sampled, level + 0.5).level;
        if (got != level) return testing::AssertionFailure() << level << " gives " << got;
    }
    return testing::AssertionSuccess();
}

TEST(Lod, NearestMip) {
    EXPECT_TRUE(prefers_finer_at_half(level_for));
    EXPECT_FALSE(prefers_finer_at_half([](const SampledTexture&, double lod) {
        return Lod{0, lod, std::floor(lod + 0.5), 0, false};  // Planted::half_up_level
    }));
}

/// 0, 2, 2, 4: as a CPU converts.
testing::AssertionResult takes_even_at_half(const LevelFunction& select) {
    RandomTexture texture(64, 64, 1);
    texture.sampled.sampler.mip = MipFilter::nearest;
    texture.sampled.sampler.level_rounding = LevelRounding::even;
    for (int level = 0; level < 4; ++level) {
        const double got = select(texture.sampled, level + 0.5).level;
        if (got != level + level % 2)
            return testing::AssertionFailure() << level << " gives " << got;
        if (select(texture.sampled, level + 0.49).level != level)
            return testing::AssertionFailure() << "not the nearest to " << level;
    }
    return testing::AssertionSuccess();
}

TEST(Lod, NearestMipHalfToEven) {
    EXPECT_TRUE(takes_even_at_half(level_for));
    EXPECT_FALSE(takes_even_at_half([](const SampledTexture&, double lod) {
        return Lod{0, lod, std::floor(lod + 0.5), 0, false};  // Planted::half_up_level
    }));
}

TEST(Lod, Quantised) {
    RandomTexture texture(64, 64, 1);
    const auto level = [&](int bits) {
        texture.sampled.sampler.lod_bits = bits;
        return level_for(texture.sampled, 1.3).level;
    };
    EXPECT_EQ(level(8), 1.30078125);
    EXPECT_EQ(level(6), 1.296875);
    EXPECT_EQ(level(4), 1.3125);
    EXPECT_EQ(level(0), 1.3);
}

TEST(Lod, BiasAndClamps) {
    RandomTexture texture(64, 64, 1);
    SamplerState& s = texture.sampled.sampler;
    s.lod_bias = 0.5f;
    EXPECT_EQ(level_for(texture.sampled, 1).level, 1.5);
    s.lod_bias = 100;  // as much as samplers allow
    EXPECT_EQ(level_for(texture.sampled, 1).lambda, 17);
    EXPECT_EQ(level_for(texture.sampled, 1).level, 6);
    s.lod_bias = 0;
    s.lod_min = 2;
    s.lod_max = 1;  // the minimum wins
    EXPECT_EQ(level_for(texture.sampled, 0).level, 2);
    EXPECT_EQ(level_for(texture.sampled, 0).lambda, 0);
}

testing::AssertionResult broken_gradients_are_coarse(const LodFunction& lod) {
    RandomTexture texture(64, 64, 1);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, std::numeric_limits<double>::quiet_NaN()}) {
        for (const LodForm form : {LodForm::sqrt_max, LodForm::ellipse, LodForm::linear_log2}) {
            texture.sampled.sampler.lod_form = form;
            const Lod got = lod(texture.sampled, {bad, 0}, {0, 1});
            if (got.level != 6) return testing::AssertionFailure() << bad << ": " << got.level;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Lod, BrokenGradients) {
    EXPECT_TRUE(broken_gradients_are_coarse(real_lod<Float>));
    EXPECT_FALSE(broken_gradients_are_coarse(  // Planted::nan_to_finest
        [](const SampledTexture& t, vec2<double> dx, vec2<double> dy) {
            return real_lod<Float>(t, std::isnan(dx.x) ? vec2<double>(0) : dx, dy);
        }));
}

TEST(Lod, QueryGivesLevelAndLambda) {
    RandomTexture texture(64, 64, 1);
    const vec2<Double> dx(Double(1000), Double(0)), dy(Double(0), Double(0));
    const auto query = texture_query_lod(texture.sampled, dx, dx, dy);
    EXPECT_EQ(first_lane(query.x), 6);
    EXPECT_NEAR(first_lane(query.y), std::log2(64000.0), 1e-12);
}

}  // namespace
}  // namespace quadrel::test
