// Fetching texels of one mip level and blending them. The blend is a + t * (b - a), x first, then
// y: a constant texture stays itself.
#pragma once

#include <concepts>

#include "quadrel/texture/address.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// One mip level as lanes see it, the same for all lanes or one each.
template <Number F>
struct LevelGeometry {
    Int<F> width, height;
    Int<F> offset;  ///< of the first texel, in floats
    F width_number, height_number;
};

template <int channels, Number F>
struct Texel {
    F channel[channels];
};

/// Level `level` for every lane.
template <Number F>
LevelGeometry<F> level_geometry(const TextureView& view, int level) {
    const std::int32_t width = view.width[level], height = view.height[level];
    return {Int<F>(width), Int<F>(height), Int<F>(view.offset[level]), F(static_cast<float>(width)),
            F(static_cast<float>(height))};
}

/// A level a lane, each in [0, levels - 1]. Neighbouring lanes mostly agree: then no gathers are
/// needed, and the values are the same.
template <Number F>
requires(!std::same_as<Int<F>, int>)  // one lane is all lanes
    LevelGeometry<F> level_geometry(const TextureView& view, Int<F> level) {
    std::int32_t lane[lanes_of<F>];
    store(lane, level);
    if (all(level == Int<F>(lane[0]))) return level_geometry<F>(view, lane[0]);
    const Int<F> width = gather_int<F>(view.width, level);
    const Int<F> height = gather_int<F>(view.height, level);
    return {width, height, gather_int<F>(view.offset, level), to_float<F>(width),
            to_float<F>(height)};
}

/// Index of the first float of texel (x, y), which must be inside the level.
template <int channels, Number F>
[[gnu::always_inline]] inline Int<F> texel_index(const LevelGeometry<F>& level, Int<F> x,
                                                 Int<F> y) {
    return level.offset + (y * level.width + x) * Int<F>(channels);
}

template <int channels, Number F>
[[gnu::always_inline]] inline Texel<channels, F> load_texel(const float* texels, Int<F> index) {
    Texel<channels, F> texel;
    if constexpr (channels == 4) {
        gather4<F>(texels, index, texel.channel);
    } else {
        for (int c = 0; c < channels; ++c) texel.channel[c] = gather<F>(texels + c, index);
    }
    return texel;
}

template <int channels, Number F>
Texel<channels, F> lerp(const Texel<channels, F>& a, const Texel<channels, F>& b, F t) {
    Texel<channels, F> result;
    for (int c = 0; c < channels; ++c) {
        result.channel[c] = lerp(a.channel[c], b.channel[c], t);
    }
    return result;
}

template <int channels, Number F>
Texel<channels, F> select(Mask<F> m, const Texel<channels, F>& a, const Texel<channels, F>& b) {
    Texel<channels, F> result;
    for (int c = 0; c < channels; ++c) {
        result.channel[c] = select(m, a.channel[c], b.channel[c]);
    }
    return result;
}

/// The border colour where a tap is outside.
template <int channels, Number F>
Texel<channels, F> border_or(Mask<F> inside, const Texel<channels, F>& texel,
                             const SamplerState& sampler) {
    Texel<channels, F> result;
    for (int c = 0; c < channels; ++c) {
        result.channel[c] = select(inside, texel.channel[c], F(sampler.border[c]));
    }
    return result;
}

inline bool has_border(const SamplerState& sampler) {
    return sampler.wrap_u == Wrap::clamp_to_border || sampler.wrap_v == Wrap::clamp_to_border;
}

/// The texel at column x and row y of the taps.
template <int channels, Number F>
Texel<channels, F> load_tap(const SampledTexture& texture, const LevelGeometry<F>& level, Int<F> x,
                            Int<F> y, Mask<F> inside) {
    const auto texel =
        load_texel<channels, F>(texture.view.texels, texel_index<channels, F>(level, x, y));
    return has_border(texture.sampler) ? border_or(inside, texel, texture.sampler) : texel;
}

template <Number F>
struct Footprint {
    AxisTaps<F> x, y;
};

template <Number F>
[[gnu::always_inline]] inline Footprint<F> address(const SampledTexture& texture,
                                                   const LevelGeometry<F>& level, const vec2<F>& uv,
                                                   Filter filter) {
    const SamplerState& sampler = texture.sampler;
    return {address_axis(uv.x, level.width, level.width_number, sampler.wrap_u, filter, sampler),
            address_axis(uv.y, level.height, level.height_number, sampler.wrap_v, filter, sampler)};
}

template <int channels, Number F>
Texel<channels, F> sample_nearest(const SampledTexture& texture, const LevelGeometry<F>& level,
                                  const vec2<F>& uv) {
    const Footprint<F> at = address(texture, level, uv, Filter::nearest);
    return load_tap<channels, F>(texture, level, at.x.first, at.y.first,
                                 at.x.first_inside & at.y.first_inside);
}

/// The 2x2 texels of a linear footprint: (first, first), (second, first), (first, second),
/// (second, second) in (x, y).
template <int channels, Number F>
struct FourTaps {
    Texel<channels, F> tap[4];
};

/// Both taps of a row.
template <int channels, Number F>
struct RowTaps {
    Texel<channels, F> first, second;
};

/// `adjacent`: in every lane the second tap is the texel after the first. One channel is then read
/// in pairs; the values are the same.
template <int channels, Number F>
[[gnu::always_inline]] inline RowTaps<channels, F> load_row(const SampledTexture& texture,
                                                            const LevelGeometry<F>& level,
                                                            const AxisTaps<F>& x, Int<F> y,
                                                            Mask<F> inside, bool adjacent) {
    const float* const texels = texture.view.texels;
    RowTaps<channels, F> row;
    if (channels == 1 && adjacent) {
        F pair[2];
        gather2<F>(texels, texel_index<channels, F>(level, x.first, y), pair);
        row.first.channel[0] = pair[0];
        row.second.channel[0] = pair[1];
    } else {
        row.first = load_texel<channels, F>(texels, texel_index<channels, F>(level, x.first, y));
        row.second = load_texel<channels, F>(texels, texel_index<channels, F>(level, x.second, y));
    }
    if (has_border(texture.sampler)) {
        row.first = border_or(x.first_inside & inside, row.first, texture.sampler);
        row.second = border_or(x.second_inside & inside, row.second, texture.sampler);
    }
    return row;
}

template <int channels, Number F>
[[gnu::always_inline]] inline FourTaps<channels, F> load_taps(const SampledTexture& texture,
                                                              const LevelGeometry<F>& level,
                                                              const Footprint<F>& at) {
    const auto& [x, y] = at;
    const bool adjacent = channels == 1 && all(x.second == x.first + Int<F>(1));
    const auto top = load_row<channels, F>(texture, level, x, y.first, y.first_inside, adjacent);
    const auto bottom =
        load_row<channels, F>(texture, level, x, y.second, y.second_inside, adjacent);
    return {{top.first, top.second, bottom.first, bottom.second}};
}

template <int channels, Number F>
[[gnu::always_inline]] inline Texel<channels, F> blend(const FourTaps<channels, F>& of, F weight_x,
                                                       F weight_y) {
    return lerp(lerp(of.tap[0], of.tap[1], weight_x), lerp(of.tap[2], of.tap[3], weight_x),
                weight_y);
}

/// Indices of the four taps of a footprint.
template <int channels, Number F>
struct TapIndices {
    Int<F> tap[4];

    TapIndices(const LevelGeometry<F>& level, const Footprint<F>& at)
        : tap{texel_index<channels, F>(level, at.x.first, at.y.first),
              texel_index<channels, F>(level, at.x.second, at.y.first),
              texel_index<channels, F>(level, at.x.first, at.y.second),
              texel_index<channels, F>(level, at.x.second, at.y.second)} {}
};

template <int channels, Number F>
Texel<channels, F> sample_linear(const SampledTexture& texture, const LevelGeometry<F>& level,
                                 const vec2<F>& uv) {
    const Footprint<F> at = address(texture, level, uv, Filter::linear);
    if constexpr (channels == 4 && requires { &PacketOps<F>::bilinear4; }) {
        if (!has_border(texture.sampler)) {
            const TapIndices<channels, F> indices(level, at);
            Texel<channels, F> result;
            PacketOps<F>::bilinear4(texture.view.texels, indices.tap, at.x.weight, at.y.weight,
                                    result.channel);
            return result;
        }
    }
    return blend(load_taps<channels, F>(texture, level, at), at.x.weight, at.y.weight);
}

}  // namespace quadrel
