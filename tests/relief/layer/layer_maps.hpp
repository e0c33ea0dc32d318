// Maps of depth layers for searches that look behind things, and rays over them.
#pragma once

#include <algorithm>

#include "quadrel/bake/bake.hpp"
#include "relief/exact/exact_search.hpp"

namespace quadrel::test {

/// Depths of a texel: front, back, second front, second back.
using Depths = std::array<float, 4>;

/// A map of depth layers with the bounds that exact searches read.
struct LayerMaps {
    Map layers, bounds;

    explicit LayerMaps(Map map) : layers(std::move(map)) {
        bounds.texture = bake(*layers.texture, BakeKind::layer_bounds, layers.sampled.sampler);
        bounds.sampled = {bounds.texture->view(), layers.sampled.sampler};
    }
    template <PlainFloat T>
    void bind(Batch<T>& batch) const {
        batch.bind(TextureSlot::layers, layers.sampled);
        batch.bind(TextureSlot::layer_bounds, bounds.sampled);
    }
};

/// Depths of a map by texel; `n` is the longer side.
struct LayerKind {
    const char* name;
    std::function<Depths(int x, int y, int n, Random& random)> depths;
};

inline Depths sorted_depths(Random& random) {
    Depths depths;
    for (float& depth : depths) depth = static_cast<float>(random.below(256)) / 255;
    std::sort(depths.begin(), depths.end());
    return depths;
}

inline const std::vector<LayerKind>& layer_kinds() {
    static const std::vector<LayerKind> kinds{
        {"slabs",
         [](int, int, int, Random&) {
             return Depths{0.25f, 0.375f, 0.5f, 0.75f};
         }},
        {"nothing",
         [](int, int, int, Random&) {
             return Depths{0.5f, 0.5f, 0.75f, 0.75f};
         }},
        {"white noise", [](int, int, int, Random& random) { return sorted_depths(random); }},
        {"flakes",
         [](int, int, int, Random& random) {
             Depths depths = sorted_depths(random);
             for (std::size_t pair = 0; pair < 4; pair += 2)
                 if (random.chance(0.7)) depths[pair + 1] = depths[pair];
             return depths;
         }},
        {"sheet",
         [](int x, int y, int n, Random&) {
             const float front = 0.1f + 0.7f * fractal_height(x, y, n);
             return Depths{front, front + 0.02f, 0.95f, 0.95f};
         }},
        {"grid",
         [](int x, int y, int, Random&) {
             const float across = x % 6 < 2 ? 0.15f : 0, along = y % 6 < 2 ? 0.15f : 0;
             return Depths{0.25f - across, 0.25f + across, 0.7f - along, 0.7f + along};
         }},
        {"ceiling",
         [](int x, int y, int n, Random&) {
             const float back = 0.2f + 0.6f * fractal_height(y, x, n);
             return Depths{0, back, 1, 1};
         }},
    };
    return kinds;
}

inline Map make_layers(const LayerKind& kind, int width, int height, int channels,
                       const SamplerState& sampler, Random& random) {
    const int n = std::max(width, height);
    Depths depths{};
    return make_map(
        width, height, channels,
        [&](int x, int y, int c) {
            if (c == 0) depths = kind.depths(x, y, n, random);
            return depths[static_cast<std::size_t>(c)];
        },
        sampler);
}

/// 1 to 24 texels a side, two channels or four, any wrap modes; borders have layers of their own.
inline LayerMaps random_layer_maps(Random& random, const LayerKind& kind) {
    SamplerState sampler = plain_sampler();
    sampler.wrap_u = static_cast<Wrap>(random.below(5));
    sampler.wrap_v = static_cast<Wrap>(random.below(5));
    const Depths border = sorted_depths(random);
    std::copy(border.begin(), border.end(), sampler.border);
    const auto side = [&] {
        return random.chance(0.1) ? 1 + random.below(3) : 4 + random.below(21);
    };
    const int width = side(), height = side();
    return LayerMaps(make_layers(kind, width, height, random.chance(0.3) ? 2 : 4, sampler, random));
}

/// A map of four channels, 16 x 16 texels, that repeats.
inline LayerMaps layer_maps(const char* name, int seed = 1) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto& kinds = layer_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const LayerKind& kind) {
        return std::string(kind.name) == name;
    });
    QUADREL_CHECK(found != kinds.end(), name);
    return LayerMaps(make_layers(*found, 16, 16, 4, plain_sampler(), random));
}

/// The same map with each texel's depths changed.
inline Map changed_layers(const Map& map, const std::function<Depths(const Depths&)>& change) {
    const TextureView& view = map.sampled.view;
    const auto depths_of = [&](int x, int y) {
        Depths depths{1, 1, 1, 1};
        for (int c = 0; c < view.channels; ++c)
            depths[static_cast<std::size_t>(c)] =
                view.texels[view.offset[0] + (y * view.width[0] + x) * view.channels + c];
        return change(depths);
    };
    SamplerState sampler = map.sampled.sampler;
    Depths border;
    std::copy_n(sampler.border, 4, border.begin());
    border = change(border);
    std::copy(border.begin(), border.end(), sampler.border);
    return make_map(
        view.width[0], view.height[0], 4,
        [&](int x, int y, int c) { return depths_of(x, y)[static_cast<std::size_t>(c)]; }, sampler);
}

/// How many layers a row searches.
inline int layers_searched(const std::string& row) { return row.find("dual") == 0 ? 2 : 4; }

}  // namespace quadrel::test
