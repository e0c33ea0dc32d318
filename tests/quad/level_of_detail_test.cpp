// The lod stage: footprint and level of the height map, of the colour map without one.
#include "quadrel/quad/level_of_detail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "quad/planted.hpp"
#include "quad/stage_bench.hpp"

namespace quadrel::quad_tests {
namespace {

/// Sizes of a full mip chain; the stage reads no texels.
SampledTexture sized(int size) {
    SampledTexture texture{};
    texture.view.channels = 1;
    texture.view.faces = 1;
    for (int n = size; n >= 1; n /= 2) {
        texture.view.width[texture.view.levels] = texture.view.height[texture.view.levels] = n;
        ++texture.view.levels;
    }
    return texture;
}

constexpr std::array lod_values = {Value::lod_rho, Value::lod_lambda, Value::lod_level,
                                   Value::lod_frac};

/// A footprint of (3, 4) and (0, 0) texels of a map of 256 texels: rho 5, log2 5 = 2.3219...
template <class T>
void run(StageBench<T>& bench, StageFunction stage, const SampledTexture* height,
         const SampledTexture* color) {
    for (const Value v : lod_values) bench.want(v);
    bench.want(Value::dUVdx);
    bench.want(Value::dUVdy);
    for (int lane = 0; lane < 16; ++lane) {
        bench.at(Value::dUVdx, 0, lane) = T(3) / 256;
        bench.at(Value::dUVdx, 1, lane) = T(4) / 256;
    }
    bench.call().textures[static_cast<int>(TextureSlot::height)] = height;
    bench.call().textures[static_cast<int>(TextureSlot::color)] = color;
    stage(&bench.call());
}

template <class T>
testing::AssertionResult follows_the_height_map(StageFunction stage) {
    const SampledTexture height = sized(256), color = sized(1024);
    const auto expect = [&](const SampledTexture* h, const SampledTexture* c,
                            std::array<double, 4> expected) -> testing::AssertionResult {
        StageBench<T> bench;
        run(bench, stage, h, c);
        for (std::size_t i = 0; i < 4; ++i)
            if (std::abs(static_cast<double>(bench.at(lod_values[i], 0, 5)) - expected[i]) > 1e-6)
                return testing::AssertionFailure()
                       << info(lod_values[i]).name << " is " << bench.at(lod_values[i], 0, 5)
                       << ", expected " << expected[i];
        return testing::AssertionSuccess();
    };
    constexpr double log2_of_5 = 2.321928094887362;
    auto both = expect(&height, &color, {5, log2_of_5, log2_of_5, log2_of_5 - 2});
    if (!both) return both;
    auto only_color = expect(nullptr, &color, {20, log2_of_5 + 2, log2_of_5 + 2, log2_of_5 - 2});
    return only_color ? expect(nullptr, nullptr, {0, 0, 0, 0}) : only_color;
}

template <class T>
void colour_map_first(const StageCall* call) {
    StageCall changed = *call;
    std::swap(changed.textures[static_cast<int>(TextureSlot::height)],
              changed.textures[static_cast<int>(TextureSlot::color)]);
    run_stage<LevelOfDetail, Quad<T>>(&changed);
}

TEST(LevelOfDetail, FollowsTheHeightMap) {
    EXPECT_TRUE(follows_the_height_map<float>(&run_stage<LevelOfDetail, Quad<float>>));
    EXPECT_TRUE(follows_the_height_map<double>(&run_stage<LevelOfDetail, Quad<double>>));
    EXPECT_FALSE(follows_the_height_map<float>(&colour_map_first<float>));
    EXPECT_FALSE(follows_the_height_map<double>(&colour_map_first<double>));
}

/// The footprint of lane i of each quad is i + 1 texels long.
using Rho = std::array<float, 4>;
Rho rho_of_lanes(bool one_a_quad, StageFunction stage) {
    SampledTexture height = sized(256);
    height.sampler.quad_lod = one_a_quad ? 1 : 0;
    StageBench<float> bench;
    for (const Value v : lod_values) bench.want(v);
    for (const Value v : {Value::dUVdx, Value::dUVdy}) bench.want(v);
    for (int lane = 0; lane < 16; ++lane)
        bench.at(Value::dUVdx, 0, lane) = static_cast<float>(lane % 4 + 1) / 256;
    bench.call().textures[static_cast<int>(TextureSlot::height)] = &height;
    stage(&bench.call());
    for (int lane = 0; lane < 16; ++lane)
        EXPECT_EQ(bench.at(Value::lod_lambda, 0, lane), log2(bench.at(Value::lod_rho, 0, lane)));
    return {bench.at(Value::lod_rho, 0, 4), bench.at(Value::lod_rho, 0, 5),
            bench.at(Value::lod_rho, 0, 6), bench.at(Value::lod_rho, 0, 7)};
}

/// As textureQueryLod of hardware that has one level for a quad.
TEST(LevelOfDetail, MayBeLane0s) {
    const StageFunction stage = &run_stage<LevelOfDetail, Quad<float>>;
    EXPECT_EQ(rho_of_lanes(false, stage), (Rho{1, 2, 3, 4}));
    EXPECT_EQ(rho_of_lanes(true, stage), (Rho{1, 1, 1, 1}));
}

/// Done to the place that textures share before each of them is asked for.
using Meddle = std::function<void(SharedScales&, const SampledTexture&)>;

/// Whether textures of several sizes and forms, some of them twice, have with a place that they
/// share the levels of detail that each has alone.
bool shared_as_alone(const Meddle& meddle) {
    std::array<SampledTexture, 3> textures{sized(256), sized(64), sized(256)};
    textures[2].sampler.lod_form = LodForm::linear_log2;
    SharedScales scales{};
    bool same = true;
    for (const int t : {0, 0, 1, 0, 2, 2, 1, 1}) {
        const SampledTexture& texture = textures[static_cast<std::size_t>(t)];
        meddle(scales, texture);
        StageBench<float> alone, sharing;
        sharing.call().scales = &scales;
        run(alone, &run_stage<LevelOfDetail, Quad<float>>, &texture, nullptr);
        run(sharing, &run_stage<LevelOfDetail, Quad<float>>, &texture, nullptr);
        for (const Value v : lod_values)
            for (int lane = 0; lane < 16; ++lane)
                same &= alone.at(v, 0, lane) == sharing.at(v, 0, lane);
    }
    return same;
}

TEST(LevelOfDetail, IsSharedByTexturesOfOneSize) {
    EXPECT_TRUE(shared_as_alone([](SharedScales&, const SampledTexture&) {}));
    EXPECT_FALSE(shared_as_alone([](SharedScales& scales, const SampledTexture& texture) {
        for (std::uint64_t& key : scales.keys)
            if (key != 0) key = scale_key(texture);  // as if there were one size
    }));
    EXPECT_FALSE(shared_as_alone([](SharedScales& scales, const SampledTexture& texture) {
        const auto form = static_cast<std::uint64_t>(texture.sampler.lod_form);
        for (std::uint64_t& key : scales.keys)
            if (key != 0) key = (key << 8 >> 8) | form << 56;  // as if there were one form
    }));
    EXPECT_FALSE(shared_as_alone([](SharedScales& scales, const SampledTexture& texture) {
        scales.keys[2] = scale_key(texture);  // of a quad that none has computed
        scales.log2_rho[9] = 1;
    }));
}

}  // namespace
}  // namespace quadrel::quad_tests
