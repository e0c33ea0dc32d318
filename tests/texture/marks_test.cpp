// Marks against their meaning: a texel is touched by a look-up exactly if, were it not a number,
// the result of an active lane would not be one either.
#include "quadrel/texture/marks.hpp"

#include <set>

#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/height_sampler.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using Float = Quad<float>;
using Texels = std::set<std::uint32_t>;

/// The operands of a look-up.
struct LookUp {
    vec3<Float> direction;  ///< x and y: uv
    vec3<Float> dx, dy;
    Float level;
    QuadMask active;
};

struct Kind {
    const char* name;
    int faces, channels;
    vec4<Float> (*run)(const SampledTexture&, const SampleContext<Float>&, const LookUp&);
};

vec2<Float> xy(const vec3<Float>& v) { return {v.x, v.y}; }

const Kind kinds[] = {
    {"gradients", 1, 4,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture_grad(t, c, xy(of.direction), xy(of.dx), xy(of.dy));
     }},
    {"implicit gradients", 1, 2,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture(t, c, xy(of.direction));
     }},
    {"a level", 1, 1,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture_lod(t, c, xy(of.direction), of.level);
     }},
    {"a texel", 1, 4,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         const vec3<Float> at = Float(9) * of.direction;
         return texel_fetch<Float>(t, c, to_int(at.x), to_int(at.y), to_int(of.level));
     }},
    {"four texels", 1, 2,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture_gather(t, c, xy(of.direction), 1);
     }},
    {"the short way of a march", 1, 1,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return vec4<Float>(FastHeight<Float>(t, 1)(c, xy(of.direction)));
     }},
    {"a cube, gradients", 6, 4,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture_cube_grad(t, c, of.direction, of.dx, of.dy);
     }},
    {"a cube, a level", 6, 1,
     [](const SampledTexture& t, const SampleContext<Float>& c, const LookUp& of) {
         return texture_cube_lod(t, c, of.direction, of.level);
     }},
};

/// Whether an active lane of the result is not a number.
bool is_spoiled(const vec4<Float>& result, const QuadMask& active) {
    for (int c = 0; c < 4; ++c)
        if (any(is_nan(result[c]) & active)) return true;
    return false;
}

/// The meaning, texel by texel.
Texels spoiling_texels(const Kind& kind, RandomTexture& texture, const LookUp& of) {
    Texels found;
    const auto channels = static_cast<std::size_t>(kind.channels);
    for (std::size_t texel = 0; texel < texture.texels.size() / channels; ++texel) {
        float* const at = texture.texels.data() + texel * channels;
        const std::vector<float> kept(at, at + channels);
        std::fill(at, at + channels, std::nanf(""));
        if (is_spoiled(kind.run(texture.sampled, {of.active}, of), of.active))
            found.insert(static_cast<std::uint32_t>(texel));
        std::copy(kept.begin(), kept.end(), at);
    }
    return found;
}

using Marker = std::function<Texels(const Kind&, const RandomTexture&, const LookUp&)>;

Texels marked_texels(const Kind& kind, const RandomTexture& texture, const LookUp& of) {
    std::vector<std::uint64_t> words(texture.texels.size() / 64 + 1);
    const TexelMarks marks{words.data()};
    FetchCounters counters;
    counters.marks = &marks;
    kind.run(texture.sampled, {of.active, &counters}, of);
    Texels found;
    for (std::uint32_t texel = 0; texel < 64 * words.size(); ++texel)
        if (words[texel / 64] >> (texel % 64) & 1) found.insert(texel);
    return found;
}

LookUp random_look_up(std::mt19937& random) {
    const auto number = [&](double low, double high) {
        Float f;
        for (float& lane : f.lane)
            lane = static_cast<float>(low + (high - low) * (random() % 4096) / 4095);
        return f;
    };
    const auto vector = [&](double size) {
        return vec3<Float>(number(-size, size), number(-size, size), number(-size, size));
    };
    // Whole levels and texel centres come up, too: their weights are 0.
    LookUp of{vector(1.5), vector(0.4), vector(0.4), number(-1, 4), QuadMask(false)};
    if (random() % 3 == 0) of.level = round_even(of.level);
    if (random() % 3 == 0)
        of.direction = (round_even(of.direction.x * Float(8)) + Float(0.5f)) / Float(8) *
                       vec3<Float>(Float(1), Float(1), Float(0.3f));
    for (int lane = 0; lane < 4; ++lane) of.active.lane[lane] = random() % 4 != 0;
    return of;
}

void choose_sampler(SamplerState& sampler, std::mt19937& random) {
    const auto filter = [&] { return random() % 3 == 0 ? Filter::nearest : Filter::linear; };
    sampler.wrap_u = all_wraps[random() % 5];
    sampler.wrap_v = all_wraps[random() % 5];
    sampler.mag = filter();
    sampler.min = filter();
    sampler.mip = static_cast<MipFilter>(random() % 3);
}

testing::AssertionResult marks_what_is_touched(const Marker& marker, const Kind& kind) {
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i) {
        RandomTexture texture(8, kind.faces == 1 ? 4 : 8, kind.channels, kind.faces);
        choose_sampler(texture.sampled.sampler, random);
        const LookUp of = random_look_up(random);
        const Texels expected = spoiling_texels(kind, texture, of);
        const Texels found = marker(kind, texture, of);
        if (found != expected)
            return testing::AssertionFailure()
                   << kind.name << ", look-up " << i << ": " << found.size() << " marked, "
                   << expected.size() << " touched";
    }
    return testing::AssertionSuccess();
}

TEST(Marks, AreWhatLookUpsTouch) {
    for (const Kind& kind : kinds) EXPECT_TRUE(marks_what_is_touched(marked_texels, kind));
}

/// Every kind notices lanes that do not ask; those with a choice, other levels and borders.
TEST(Marks, PlantedErrorsAreCaught) {
    const auto with = [](Planted error) {
        return [error](const Kind& kind, const RandomTexture& texture, LookUp of) {
            RandomTexture other(8, kind.faces == 1 ? 4 : 8, kind.channels, kind.faces);
            other.sampled.sampler = texture.sampled.sampler;
            SamplerState& sampler = other.sampled.sampler;
            if (error == Planted::marks_of_all_lanes) of.active = QuadMask(true);
            if (error == Planted::finer_level_only) sampler.mip = MipFilter::nearest;
            if (error == Planted::border_is_edge) {
                if (sampler.wrap_u == Wrap::clamp_to_border) sampler.wrap_u = Wrap::clamp_to_edge;
                if (sampler.wrap_v == Wrap::clamp_to_border) sampler.wrap_v = Wrap::clamp_to_edge;
            }
            return marked_texels(kind, other, of);
        };
    };
    for (const Kind& kind : kinds)
        EXPECT_FALSE(marks_what_is_touched(with(Planted::marks_of_all_lanes), kind)) << kind.name;
    for (const int kind : {0, 1, 2, 6, 7})
        EXPECT_FALSE(marks_what_is_touched(with(Planted::finer_level_only), kinds[kind]));
    for (const int kind : {0, 1, 2, 4, 5})
        EXPECT_FALSE(marks_what_is_touched(with(Planted::border_is_edge), kinds[kind]));
}

}  // namespace
}  // namespace quadrel::test
