// The level of detail that llvmpipe takes for a whole quad. Numbers are what shaders gave under
// Mesa 22.3.6 (LLVM 15.0.6), read back from a float target; lanes 0 1 / 2 3.
#include "quadrel/texture/cube.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using Float = Quad<float>;
using Lanes4 = std::array<float, 4>;

/// 64 x 64 texels and their mips, level l holding l everywhere: a look-up gives its level.
struct LevelTexture : RandomTexture {
    explicit LevelTexture(int faces = 1) : RandomTexture(64, 64, 1, faces) {
        const TextureView& view = sampled.view;
        for (int l = 0; l < view.levels; ++l) {
            const std::ptrdiff_t count = std::ptrdiff_t(view.width[l]) * view.height[l] * faces;
            std::fill_n(texels.begin() + view.offset[l], count, static_cast<float>(l));
        }
        sampled.sampler.lod_form = LodForm::linear_log2;
        sampled.sampler.quad_lod = 1;
    }
};

Float lanes(float a, float b, float c, float d) {
    Float of;
    of.lane[0] = a, of.lane[1] = b, of.lane[2] = c, of.lane[3] = d;
    return of;
}

Lanes4 read(const Float& v) { return {v.lane[0], v.lane[1], v.lane[2], v.lane[3]}; }

/// exp2(lane) / 32 times gl_FragCoord.x.
const Float bent = lanes(0.5f / 32, 2 * 1.5f / 32, 4 * 0.5f / 32, 8 * 1.5f / 32);

using LodLookUp = std::function<Float(const SampledTexture&, const vec2<Float>& uv, Float bias)>;

Float with_bias(const SampledTexture& t, const vec2<Float>& uv, Float bias) {
    return texture_bias(t, SampleContext<Float>(), uv, bias).x;
}
Float of_each_lane(const SampledTexture& t, const vec2<Float>& uv, Float bias) {
    SampledTexture own = t;
    own.sampler.quad_lod = 0;
    return with_bias(own, uv, bias);
}
Float bias_of_lane_0(const SampledTexture& t, const vec2<Float>& uv, Float bias) {
    return with_bias(t, uv, broadcast_lane<0>(bias));
}

/// texture(map, (bent, 0)) and texture(map, (x / 16, 0.3), lane / 2).
testing::AssertionResult has_llvmpipes_levels(const LodLookUp& look_up) {
    const LevelTexture texture;
    const Lanes4 plain = read(look_up(texture.sampled, {bent, Float(0)}, Float(0)));
    const vec2<Float> straight(lanes(0.5f / 16, 1.5f / 16, 0.5f / 16, 1.5f / 16), Float(0.3f));
    const Lanes4 biased = read(look_up(texture.sampled, straight, lanes(0, 0.5f, 1, 1.5f)));
    if (plain != Lanes4{2.28125f, 2.28125f, 2.28125f, 2.28125f})
        return testing::AssertionFailure() << "implicit: " << testing::PrintToString(plain);
    if (biased != Lanes4{2, 2.5f, 3, 3.5f})
        return testing::AssertionFailure() << "with bias: " << testing::PrintToString(biased);
    return testing::AssertionSuccess();
}

TEST(QuadLod, ImplicitLookUpsHaveTheLevelOfLane0) {
    EXPECT_TRUE(has_llvmpipes_levels(with_bias));
    EXPECT_FALSE(has_llvmpipes_levels(of_each_lane))
        << static_cast<int>(Planted::level_of_each_lane);
    EXPECT_FALSE(has_llvmpipes_levels(bias_of_lane_0)) << static_cast<int>(Planted::bias_of_lane_0);
}

TEST(QuadLod, TextureIsTextureWithoutABias) {
    const LevelTexture texture;
    EXPECT_EQ(read(quadrel::texture(texture.sampled, SampleContext<Float>(), {bent, Float(0)}).x),
              (Lanes4{2.28125f, 2.28125f, 2.28125f, 2.28125f}));
}

TEST(QuadLod, GivenLevelsAndGradientsAreEachLanesOwn) {
    const LevelTexture texture;
    const vec2<Float> uv(Float(0.3f)), none(Float(0));
    const SampleContext<Float> context;
    const Float level = texture_lod(texture.sampled, context, uv, lanes(0, 1.25f, 2.5f, 3.75f)).x;
    EXPECT_EQ(read(level), (Lanes4{0, 1.25f, 2.5f, 3.75f}));
    const vec2<Float> dx(lanes(1.0f / 64, 2.0f / 64, 4.0f / 64, 8.0f / 64), Float(0));
    EXPECT_EQ(read(texture_grad(texture.sampled, context, uv, dx, none).x), (Lanes4{0, 1, 2, 3}));
}

TEST(QuadLod, DerivativesAreEachRowsAndColumnsOwn) {
    EXPECT_EQ(read(dFdx(bent) * Float(64)), (Lanes4{5, 5, 20, 20}));
    EXPECT_EQ(read(dFdy(bent) * Float(64)), (Lanes4{3, 18, 3, 18}));
}

/// texture(cube, (bent, 0, 1)).
TEST(QuadLod, CubeMapsHaveEachLanesOwn) {
    const LevelTexture texture(6);
    const vec3<Float> direction(bent, Float(0), Float(1));
    const Lanes4 levels = read(texture_cube(texture.sampled, SampleContext<Float>(), direction).x);
    const Lanes4 observed = {1.28125f, 3.1328125f, 3.28125f, 3.28125f};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(levels[i], observed[i], 1e-6) << i;
}

}  // namespace
}  // namespace quadrel::test
