// Height fields for the tests of baked maps, and the field itself by the reference sampler.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "bake/planted.hpp"
#include "quadrel/bake/bake.hpp"
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

/// A copy with every value v of channel c at level, layer, i, j replaced by change(...).
inline Texels with_values(
    const Texture& map,
    const std::function<float(float v, int level, int layer, int i, int j, int c)>& change) {
    const auto copy = std::make_shared<Texture>(map.view(), map.format(), map.id());
    const TextureView& view = map.view();
    for (int level = 0; level < view.levels; ++level) {
        for (int layer = 0; layer < view.faces; ++layer) {
            const float* from = map.level_texels(level, layer);
            float* to = copy->level_texels(level, layer);
            for (int j = 0; j < view.height[level]; ++j)
                for (int i = 0; i < view.width[level]; ++i)
                    for (int c = 0; c < view.channels; ++c)
                        *to++ = change(*from++, level, layer, i, j, c);
        }
    }
    return copy;
}

/// A copy with one value changed.
inline Texels with_value(const Texture& map, int level, int layer, int i, int j, int c,
                         const std::function<float(float)>& change) {
    return with_values(map, [&](float v, int l, int y, int x0, int y0, int c0) {
        return l == level && y == layer && x0 == i && y0 == j && c0 == c ? change(v) : v;
    });
}

/// Random and stress fields of a few shapes.
inline std::vector<Texels> small_fields() {
    std::vector<Texels> fields = stress_fields(7, 5);
    fields.push_back(random_field(8, 3, 11));
    fields.push_back(random_field(3, 7, 12));
    fields.push_back(random_field(1, 1, 13));
    fields.push_back(random_field(1, 6, 14));
    return fields;
}

/// Checks a property of a baked map on small fields under every pair of wrap modes.
using MapCheck = std::function<testing::AssertionResult(const Texture& map, const Texture& field,
                                                        const SamplerState& sampler)>;

inline SamplerState repeat() { return sampler_with(Wrap::repeat, Wrap::repeat); }

inline testing::AssertionResult holds_for_small_fields(const Baker& baked, const MapCheck& check) {
    for (const Texels& field : small_fields()) {
        for (const SamplerState& sampler : all_samplers()) {
            auto result = check(*baked(*field, sampler), *field, sampler);
            if (!result) return result << ", " << describe(*field, sampler);
        }
    }
    return testing::AssertionSuccess();
}

/// A baker whose values go through `change`.
inline Baker changed(
    const Baker& baked,
    const std::function<float(float v, int level, int layer, int i, int j, int c)>& change) {
    return [=](const Texture& field, const SamplerState& sampler) {
        return with_values(*baked(field, sampler), change);
    };
}

}  // namespace quadrel::test
