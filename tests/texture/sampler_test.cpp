// Two-dimensional look-ups against the specification's formulas.
#include "quadrel/texture/sampler.hpp"

#include "quadrel/texture/height_sampler.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using Float = Quad<float>;
using Double = Quad<double>;

struct Size {
    int width, height;
};
constexpr Size texture_sizes[] = {{1, 1}, {1, 7}, {5, 1}, {4, 4}, {13, 6}, {64, 32}};

/// Every wrap, filter and mip combination at random coordinates, against the reference;
/// `bound(size)` is the largest difference allowed at a side of that many texels.
testing::AssertionResult matches_reference(const Sampler& sampler,
                                           const std::function<double(int)>& bound) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-2.5f, 3.5f), level(-1, 7);
    for (const Size size : texture_sizes) {
        for (int channels : {1, 2, 4}) {
            RandomTexture texture(size.width, size.height, channels);
            SamplerState& s = texture.sampled.sampler;
            for (int c = 0; c < 4; ++c) s.border[c] = 2.0f + static_cast<float>(c);
            for (int trial = 0; trial < 400; ++trial) {
                s.wrap_u = all_wraps[random() % 5];
                s.wrap_v = all_wraps[random() % 5];
                s.mag = static_cast<Filter>(random() % 2);
                s.min = static_cast<Filter>(random() % 2);
                s.mip = static_cast<MipFilter>(random() % 3);
                const double u = coordinate(random), v = coordinate(random), lod = level(random);
                const auto want = reference_sample(texture.sampled, u, v, lod);
                const auto got = sampler(texture.sampled, u, v, lod);
                for (int c = 0; c < 4; ++c) {
                    const double allowed = bound(std::max(size.width, size.height));
                    if (std::fabs(got[c] - want[c]) <= allowed) continue;
                    return testing::AssertionFailure()
                           << "channel " << c << " of " << channels << " at (" << u << ", " << v
                           << ") lod " << lod << ": " << got[c] << ", want " << want[c] << "; size "
                           << size.width << "x" << size.height << " wraps " << int(s.wrap_u) << " "
                           << int(s.wrap_v) << " filters " << int(s.mag) << int(s.min)
                           << int(s.mip);
                }
            }
        }
    }
    return testing::AssertionSuccess();
}

double double_bound(int) { return 1e-12; }
/// Coordinates near 3.5 carry 2^-22 of the texture, n 2^-22 texels; texels differ by at most 5.
double float_bound(int size) { return 5 * (2 * size * 0x1p-22 + 8 * 0x1p-24); }

/// A defective sampler made from the real one.
Sampler planted_sampler(Planted planted) {
    return [planted](const SampledTexture& given, double u, double v, double lod) {
        SampledTexture t = given;
        SamplerState& s = t.sampler;
        const double half_x = 0.5 / t.view.width[0], half_y = 0.5 / t.view.height[0];
        switch (planted) {
            case Planted::half_texel:
                return sample_lod<Double>(t, u + half_x, v + half_y, lod);
            case Planted::swapped_weights: {
                const double x = u * t.view.width[0], y = v * t.view.height[0];
                const double swap = (y - std::floor(y)) - (x - std::floor(x));
                return sample_lod<Double>(t, u + 2 * swap * half_x, v - 2 * swap * half_y, lod);
            }
            case Planted::next_row_up:
                return sample_lod<Double>(t, u, v - 2 * half_y, lod);
            case Planted::border_is_edge:
                if (s.wrap_u == Wrap::clamp_to_border) s.wrap_u = Wrap::clamp_to_edge;
                if (s.wrap_v == Wrap::clamp_to_border) s.wrap_v = Wrap::clamp_to_edge;
                break;
            case Planted::mirror_without_edge:
                if (s.wrap_u == Wrap::mirrored_repeat) u *= (t.view.width[0] - 0.5) * 2 * half_x;
                break;
            case Planted::negative_remainder:
                if (s.wrap_u == Wrap::repeat && u < 0) u = -u;
                break;
            case Planted::missing_alpha_zero: {
                vec4<double> texel = sample_lod<Double>(t, u, v, lod);
                if (t.view.channels < 4) texel.w = 0;
                return texel;
            }
            case Planted::finer_level_only:
                lod = s.mip == MipFilter::linear ? std::floor(lod) : lod;
                break;
            case Planted::half_up_level:
                lod = s.mip == MipFilter::nearest ? std::ceil(lod) : lod;
                break;
            default:
                break;
        }
        return sample_lod<Double>(t, u, v, lod);
    };
}

TEST(Sampler, MatchesReference) {
    EXPECT_TRUE(matches_reference(sample_lod<Double>, double_bound));
    // Nearest filtering jumps: random coordinates do not come within rounding of an edge here.
    EXPECT_TRUE(matches_reference(sample_lod<Float>, float_bound));
}

TEST(Sampler, PlantedErrorsAreCaught) {
    for (const Planted planted :
         {Planted::half_texel, Planted::swapped_weights, Planted::next_row_up,
          Planted::border_is_edge, Planted::mirror_without_edge, Planted::negative_remainder,
          Planted::missing_alpha_zero, Planted::finer_level_only, Planted::half_up_level}) {
        EXPECT_FALSE(matches_reference(planted_sampler(planted), double_bound)) << int(planted);
    }
    EXPECT_TRUE(matches_reference(planted_sampler(Planted::none), double_bound));
}

/// Nearest texels of a row that counts up, one a column of `want`, from texel index -6 on.
std::vector<int> wrapped_indices(Wrap wrap, bool scale_first) {
    RowTexture texture({0, 1, 2, 3});
    SamplerState& s = texture.sampled.sampler;
    s.wrap_u = wrap;
    s.mag = s.min = Filter::nearest;
    s.border[0] = -1;
    s.scale_first = scale_first ? 1 : 0;
    std::vector<int> indices;
    for (int i = -6; i <= 9; ++i) {
        const double u = (i + 0.5) / 4;
        indices.push_back(static_cast<int>(sample_lod<Float>(texture.sampled, u, 0.5, 0).x));
    }
    return indices;
}

TEST(Sampler, WrapsIndices) {
    using Indices = std::vector<int>;
    for (const bool scale_first : {false, true}) {
        EXPECT_EQ(wrapped_indices(Wrap::repeat, scale_first),
                  (Indices{2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1}));
        EXPECT_EQ(wrapped_indices(Wrap::mirrored_repeat, scale_first),
                  (Indices{2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1}));
        EXPECT_EQ(wrapped_indices(Wrap::clamp_to_edge, scale_first),
                  (Indices{0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3}));
        EXPECT_EQ(wrapped_indices(Wrap::clamp_to_border, scale_first),
                  (Indices{-1, -1, -1, -1, -1, -1, 0, 1, 2, 3, -1, -1, -1, -1, -1, -1}));
        EXPECT_EQ(wrapped_indices(Wrap::mirror_once, scale_first),
                  (Indices{3, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3}));
    }
}

double sample_row(Wrap wrap, double u, int weight_bits = 0, Filter filter = Filter::linear) {
    RowTexture texture({10, 20, 30, 40});
    SamplerState& s = texture.sampled.sampler;
    s.wrap_u = wrap;
    s.weight_bits = weight_bits;
    s.mag = s.min = filter;
    return sample_lod<Double>(texture.sampled, u, 0.5, 0).x;
}

TEST(Sampler, FiltersARow) {
    constexpr Wrap wraps[] = {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat,
                              Wrap::clamp_to_border};
    constexpr double at[] = {0, 1, -0.125};
    constexpr double want[][4] = {{25, 10, 10, 5}, {25, 40, 40, 20}, {40, 10, 10, 0}};
    for (int i = 0; i < 3; ++i) {
        for (int w = 0; w < 4; ++w) EXPECT_EQ(sample_row(wraps[w], at[i]), want[i][w]);
    }
    EXPECT_NEAR(sample_row(Wrap::repeat, 0.3), 17, 1e-12);
    EXPECT_EQ(sample_row(Wrap::repeat, 0.125), 10);
}

using RowSampler = std::function<double(double u, int weight_bits, Filter filter)>;

/// Weights are rounded before the coordinate is split: nearest just below an edge takes the next.
testing::AssertionResult rounds_before_split(const RowSampler& row) {
    if (row(0.3, 8, Filter::linear) != 16.9921875) return testing::AssertionFailure() << "8 bits";
    if (row(0.3, 4, Filter::linear) != 16.875) return testing::AssertionFailure() << "4 bits";
    if (row(2.9985 / 4, 0, Filter::nearest) != 30) return testing::AssertionFailure() << "exact";
    if (row(2.9985 / 4, 8, Filter::nearest) != 40) return testing::AssertionFailure() << "next";
    return testing::AssertionSuccess();
}

TEST(Sampler, WeightBits) {
    EXPECT_TRUE(rounds_before_split([](double u, int bits, Filter filter) {
        return sample_row(Wrap::repeat, u, bits, filter);
    }));
    EXPECT_FALSE(rounds_before_split([](double u, int bits, Filter filter) {  // weight_after_floor
        return sample_row(Wrap::repeat, u, filter == Filter::nearest ? 0 : bits, filter);
    }));
}

TEST(Sampler, ConstantsStay) {
    RandomTexture texture(13, 6, 4);
    std::fill(texture.texels.begin(), texture.texels.end(), 0.1f);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-2, 2), level(0, 4);
    for (int i = 0; i < 1000; ++i) {
        const auto texel = sample_lod<Float>(texture.sampled, coordinate(random),
                                             coordinate(random), level(random));
        for (int c = 0; c < 4; ++c) ASSERT_EQ(texel[c], 0.1f);
    }
}

TEST(Sampler, Gather) {
    RandomTexture texture(4, 4, 1);
    for (int i = 0; i < 16; ++i) texture.texels[i] = static_cast<float>(10 * (i / 4) + i % 4);
    const SampleContext<Double> all;
    const auto gather = [&](double u, double v) {
        return first_lane(texture_gather(texture.sampled, all, {Double(u), Double(v)}));
    };
    EXPECT_EQ(gather(0.5, 0.5), vec4<double>(21, 22, 12, 11));
    EXPECT_EQ(gather(0.3, 0.8), vec4<double>(30, 31, 21, 20));
}

TEST(Sampler, FetchOutOfRangeIsZero) {
    RandomTexture texture(5, 3, 2);
    const SampleContext<Float> all;
    const auto fetch = [&](int x, int y, int level) {
        return first_lane(texel_fetch<Float>(texture.sampled, all, x, y, level));
    };
    const auto stored = [&](int i) { return static_cast<double>(texture.texels[i]); };
    EXPECT_EQ(fetch(4, 2, 0), vec4<double>(stored(28), stored(29), 0, 1));
    EXPECT_EQ(fetch(1, 0, 1), vec4<double>(stored(32), stored(33), 0, 1));
    for (const auto [x, y, level] :
         {std::array{-1, 0, 0}, {5, 0, 0}, {0, 3, 0}, {2, 0, 1}, {0, 0, 3}, {0, 0, -1}}) {
        EXPECT_EQ(fetch(x, y, level), vec4<double>(0, 0, 0, 1));
    }
}

TEST(Sampler, OddCoordinatesAreCountedInActiveLanes) {
    RandomTexture texture(8, 8, 1);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    FetchCounters counters;
    SampleContext<Float> context{QuadMask(true), &counters};
    context.active.lane[3] = false;
    const Float odd(nan, infinity, -1e30f, nan);
    for (const Wrap wrap : all_wraps) {
        texture.sampled.sampler.wrap_u = texture.sampled.sampler.wrap_v = wrap;
        const auto texel = texture_lod(texture.sampled, context, {odd, Float(0.3f)}, Float(0));
        for (float value : texel.x.lane) EXPECT_TRUE(value >= 0 && value <= 1) << int(wrap);
        const auto zero = sample_lod<Float>(texture.sampled, 0, 0.3f, 0);
        EXPECT_EQ(texel.x.lane[0], zero.x) << "NaN reads as 0";
    }
    EXPECT_EQ(counters.fetches, 5u * 3);
    EXPECT_EQ(counters.nan_coordinates, 5u);
    EXPECT_EQ(counters.huge_coordinates, 5u * 2);
}

using HeightPair = std::function<bool(const SampledTexture&, const vec2<Float>&)>;

testing::AssertionResult models_agree(const HeightPair& agree) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(-3, 3);
    for (const Size size : texture_sizes) {
        RandomTexture texture(size.width, size.height, 1);
        SamplerState& s = texture.sampled.sampler;
        s.mip = MipFilter::none;
        for (int i = 0; i < 500; ++i) {
            s.wrap_u = all_wraps[random() % 5];
            s.wrap_v = all_wraps[random() % 5];
            const auto next = [&] { return coordinate(random); };
            const vec2<Float> uv{{next(), next(), next(), next()},
                                 {next(), next(), next(), next()}};
            if (!agree(texture.sampled, uv)) return testing::AssertionFailure() << "trial " << i;
        }
    }
    return testing::AssertionSuccess();
}

TEST(HeightSampler, ModelsAgreeBitForBit) {
    const SampleContext<Float> all_lanes;
    const auto agree_with = [&](float shift) {
        return [&, shift](const SampledTexture& t, const vec2<Float>& uv) {
            const FastHeight<Float> fast(t);
            const GeneralHeight<Float> general(t, uv, uv);
            const vec2<Float> moved(uv.x + Float(shift), uv.y);
            return FastHeight<Float>::applies(t) &&
                   all(as_int(fast(all_lanes, moved)) == as_int(general(all_lanes, uv)));
        };
    };
    EXPECT_TRUE(models_agree(agree_with(0)));
    EXPECT_FALSE(models_agree(agree_with(1e-5f)));
}

}  // namespace
}  // namespace quadrel::test
