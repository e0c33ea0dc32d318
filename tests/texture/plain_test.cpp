// Look-ups on plain numbers are those of a packet's lanes, bit for bit, and count as they do.
#include <bit>

#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

/// What a look-up on plain numbers gives: r g b a.
template <class T>
using PlainLookUp = std::function<vec4<T>(const SampledTexture&, const SampleContext<T>&,
                                          const vec2<T>& uv, const vec2<T>& dx, T lod)>;

/// Any wrap, filter and mip mode.
SamplerState random_sampler(std::mt19937& random) {
    SamplerState s;
    s.wrap_u = all_wraps[random() % 5];
    s.wrap_v = all_wraps[random() % 5];
    s.mag = static_cast<Filter>(random() % 2);
    s.min = static_cast<Filter>(random() % 2);
    s.mip = static_cast<MipFilter>(random() % 3);
    for (int c = 0; c < 4; ++c) s.border[c] = 2.0f + static_cast<float>(c);
    return s;
}

template <class T>
bool same_bits(const vec4<T>& plain, const vec4<Quad<T>>& packet) {
    using Bits = std::conditional_t<std::same_as<T, float>, std::uint32_t, std::uint64_t>;
    for (int c = 0; c < 4; ++c)
        for (const T lane : packet[c].lane)
            if (std::bit_cast<Bits>(plain[c]) != std::bit_cast<Bits>(lane)) return false;
    return true;
}

/// `plain` against the same look-up on four equal lanes, which counts four times as much and marks
/// the same texels.
template <class T>
testing::AssertionResult agrees(const PlainLookUp<T>& plain, const PlainLookUp<Quad<T>>& packet) {
    std::mt19937 random(3);
    std::uniform_real_distribution<T> coordinate(-2, 3), level(-1, 5), step(0, T(0.5));
    for (int trial = 0; trial < 300; ++trial) {
        RandomTexture texture(13, 6, 1 << random() % 3);
        texture.sampled.sampler = random_sampler(random);
        std::uint64_t words[2][16] = {};
        const TexelMarks marks[2] = {{words[0]}, {words[1]}};
        FetchCounters one, four;
        one.marks = &marks[0];
        four.marks = &marks[1];
        const vec2<T> uv(coordinate(random), coordinate(random)), dx(step(random), step(random));
        const T lod = level(random);
        const auto wide = [](const vec2<T>& v) { return vec2<Quad<T>>(v.x, v.y); };
        const vec4<T> got = plain(texture.sampled, {true, &one, nullptr}, uv, dx, lod);
        const vec4<Quad<T>> want =
            packet(texture.sampled, {true, &four, nullptr}, wide(uv), wide(dx), lod);
        if (!same_bits(got, want) || !std::ranges::equal(words[0], words[1]) ||
            4 * one.fetches != four.fetches)
            return testing::AssertionFailure() << "trial " << trial << " at " << uv.x << " " << uv.y
                                               << " lod " << lod << ": " << got.x;
    }
    return testing::AssertionSuccess();
}

/// One generic look-up as both functions of `agrees`.
template <class T, class LookUp>
testing::AssertionResult agrees_with_itself(const LookUp& look_up) {
    return agrees<T>(look_up, look_up);
}

template <class T>
class Plain : public testing::Test {};
using PlainTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(Plain, PlainTypes);

TYPED_TEST(Plain, LookUpsAreThoseOfALane) {
    using T = TypeParam;
    EXPECT_TRUE(agrees_with_itself<T>([](auto& t, auto& context, auto& uv, auto&, auto lod) {
        return texture_lod(t, context, uv, lod);
    }));
    EXPECT_TRUE(agrees_with_itself<T>([](auto& t, auto& context, auto& uv, auto& dx, auto) {
        return texture_grad(t, context, uv, dx, {dx.y, dx.x});
    }));
    EXPECT_TRUE(agrees_with_itself<T>([](auto& t, auto& context, auto& uv, auto&, auto) {
        return texture_gather(t, context, uv, 2);
    }));
    EXPECT_TRUE(agrees_with_itself<T>([](auto& t, auto& context, auto& uv, auto&, auto lod) {
        return texel_fetch(t, context, to_int(uv.x * 4.0f), to_int(uv.y * 4.0f), to_int(lod));
    }));
}

TYPED_TEST(Plain, TheCheckSeesADifference) {
    using T = TypeParam;
    const auto real = [](auto& t, auto& context, auto& uv, auto&, auto lod) {
        return texture_lod(t, context, uv, lod);
    };
    // Planted errors: the level, the place, the marks, the count.
    const PlainLookUp<T> finer_level_only = [](auto& t, auto& context, auto& uv, auto&, auto lod) {
        return texture_lod(t, context, uv, floor(lod));
    };
    const PlainLookUp<T> half_texel = [](auto& t, auto& context, auto& uv, auto&, auto lod) {
        return texture_lod(t, context, uv + T(0.5) / T(t.view.width[0]), lod);
    };
    const PlainLookUp<T> no_marks = [](auto& t, auto& context, auto& uv, auto&, auto lod) {
        FetchCounters counters;
        const auto value = texture_lod(t, {true, &counters, nullptr}, uv, lod);
        *context.counters += counters;
        return value;
    };
    const PlainLookUp<T> no_count = [](auto& t, auto& context, auto& uv, auto&, auto lod) {
        const auto value = texture_lod(t, context, uv, lod);
        context.counters->fetches = 0;
        return value;
    };
    for (const PlainLookUp<T>& planted : {finer_level_only, half_texel, no_marks, no_count})
        EXPECT_FALSE(agrees<T>(planted, real));
}

TYPED_TEST(Plain, CubesToo) {
    using T = TypeParam;
    RandomTexture cube(8, 8, 4, 6);
    std::mt19937 random(5);
    std::uniform_real_distribution<T> part(-1, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const vec3<T> direction(part(random), part(random), part(random));
        const vec3<Quad<T>> wide(direction.x, direction.y, direction.z);
        EXPECT_TRUE(same_bits<T>(texture_cube_lod(cube.sampled, {}, direction, 0.5f),
                                 texture_cube_lod(cube.sampled, {}, wide, 0.5f)));
    }
}

TEST(Literals, BecomeTheNumberOfTheCoordinates) {
    const float checks[] = {0, 1, 1, 0};
    SamplerState sampler;
    sampler.mag = Filter::nearest;
    const SampledTexture t = texture_of_texels(checks, 2, 2, sampler);
    EXPECT_EQ(texture_lod(t, {}, vec2<float>(0.75f, 0.25f), 0.0f), vec4<float>(1, 0, 0, 1));
    EXPECT_EQ(texture_lod<float>(t, {}, {0.25f, 0.25f}, 0), vec4<float>(0, 0, 0, 1));
    EXPECT_EQ(texture_lod(t, {}, vec2<double>(0.75, 0.25), 0.0f).x, 1);
    EXPECT_EQ(texture_lod(t, {}, vec2<Quad<float>>(0.75f, 0.25f), 0.0f).x.lane[3], 1);
    EXPECT_EQ(texture_lod(t, {}, vec2<Quad<double>>(0.75, 0.25), 0).x.lane[3], 1);
    EXPECT_EQ(texture_bias(t, {}, vec2<Quad<float>>(0.75f, 0.25f), 0.5f).x.lane[0], 1);
    EXPECT_EQ(texture_grad(t, {}, vec2<float>(0.75f, 0.25f), {0, 0}, {0, 0}).x, 1);
}

TEST(TextureOfTexels, RefusesWhatIsNoTexture) {
    const float texels[12] = {};
    EXPECT_EQ(texture_of_texels(texels, 3, 2).view.channels, 2);
    EXPECT_EQ(texture_of_texels(texels, 3, 1).view.channels, 4);
    EXPECT_THROW(texture_of_texels(texels, 2, 2), std::invalid_argument);  // three channels
    EXPECT_THROW(texture_of_texels(texels, 5, 1), std::invalid_argument);
    EXPECT_THROW(texture_of_texels(texels, 0, 2), std::invalid_argument);
    EXPECT_THROW(texture_of_texels({}, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace quadrel::test
