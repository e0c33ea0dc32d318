// Height fields for the tests of baked maps, and the field itself by the reference sampler.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "bake/planted.hpp"
#include "quadrel/bake.hpp"
#include "texture/support.hpp"

namespace quadrel::test {

using Texels = std::shared_ptr<const Texture>;

/// Bakes a map; what the properties are checked on.
using Baker = std::function<Texels(const Texture& height, const SamplerState& sampler)>;

inline Baker baker(BakeKind kind, BakeOptions options = {}) {
    return [kind, options](const Texture& height, const SamplerState& sampler) {
        return bake(height, kind, sampler, options);
    };
}

/// A field of heights by column and row.
template <class Height>
Texels make_field(int width, int height, const Height& at) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 1;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) image.values.push_back(static_cast<float>(at(i, j)));
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

inline Texels random_field(int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    return make_field(width, height,
                      [&](int, int) { return static_cast<float>(random() >> 8) * 0x1p-24f; });
}

/// Fields that break searches: flat, one texel, walls, checkers, steps, a ramp.
inline std::vector<Texels> stress_fields(int width, int height) {
    const auto wave = [](int i, int j) { return ((i * 7 + j * 3) % 11) / 11.0; };
    return {make_field(width, height, [](int, int) { return 0.5; }),
            make_field(width, height, [](int i, int j) { return i == 2 && j == 1 ? 1.0 : 0.0; }),
            make_field(width, height, [](int i, int) { return i == 1 ? 1.0 : 0.25; }),
            make_field(width, height, [](int i, int j) { return i == j ? 1.0 : 0.0; }),
            make_field(width, height, [](int i, int j) { return (i + j) % 2 ? 1.0 : 0.0; }),
            make_field(width, height, [&](int i, int) { return i / double(width); }),
            make_field(width, height, [](int i, int j) { return (i / 2 + j / 3) / 16.0; }),
            make_field(width, height, wave)};
}

inline SamplerState sampler_with(Wrap u, Wrap v, float border = 0.75f) {
    SamplerState sampler;
    sampler.wrap_u = u;
    sampler.wrap_v = v;
    sampler.mip = MipFilter::none;
    sampler.border[0] = border;
    return sampler;
}

/// Every pair of wrap modes.
inline std::vector<SamplerState> all_samplers() {
    std::vector<SamplerState> all;
    for (const Wrap u : all_wraps)
        for (const Wrap v : all_wraps) all.push_back(sampler_with(u, v));
    return all;
}

inline std::string describe(const Texture& field, const SamplerState& sampler) {
    return std::to_string(field.view().width[0]) + "x" + std::to_string(field.view().height[0]) +
           " wrap " + std::to_string(static_cast<int>(sampler.wrap_u)) + " " +
           std::to_string(static_cast<int>(sampler.wrap_v));
}

/// Height of texel (i, j) anywhere in the plane.
inline double height_at(const Texture& field, const SamplerState& sampler, int i, int j) {
    return reference_texel({field.view(), sampler}, 0, i, j, 0);
}

/// Bilinear height at texel coordinates (texel centres at whole numbers).
inline double bilinear_at(const Texture& field, const SamplerState& sampler, double x, double y) {
    const double i = std::floor(x), j = std::floor(y), a = x - i, b = y - j;
    const auto h = [&](int di, int dj) {
        return height_at(field, sampler, static_cast<int>(i) + di, static_cast<int>(j) + dj);
    };
    return (h(0, 0) * (1 - a) + h(1, 0) * a) * (1 - b) + (h(0, 1) * (1 - a) + h(1, 1) * a) * b;
}

inline float texel_of(const Texture& map, int level, int layer, int i, int j, int c = 0) {
    const TextureView& view = map.view();
    return map.level_texels(level, layer)[(j * view.width[level] + i) * view.channels + c];
}

/// A copy with one value changed.
inline Texels with_value(const Texture& map, int level, int layer, int i, int j, int c,
                         const std::function<float(float)>& change) {
    const auto copy = std::make_shared<Texture>(map.view(), map.format(), map.id());
    const TextureView& view = map.view();
    for (int l = 0; l < view.levels; ++l) {
        const std::size_t floats =
            std::size_t(view.width[l]) * view.height[l] * view.channels * view.faces;
        std::copy_n(map.level_texels(l, 0), floats, copy->level_texels(l, 0));
    }
    float& value =
        copy->level_texels(level, layer)[(j * view.width[level] + i) * view.channels + c];
    value = change(value);
    return copy;
}

}  // namespace quadrel::test
