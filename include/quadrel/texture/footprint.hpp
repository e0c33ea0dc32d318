// What a look-up touches: which texels, with which weights. Made with the sampler's own addressing,
// so that addresses and weights are those of the fetch, bit for bit.
#pragma once

#include <algorithm>
#include <vector>

#include "quadrel/texture/sampler.hpp"

namespace quadrel {

/// One texel of a footprint.
struct TexelTap {
    std::int32_t level = 0, x = 0, y = 0;
    bool border = false;  ///< outside with clamp_to_border: the border colour is read instead
    double weight = 0;    ///< share in the result; the taps of a footprint sum to 1
    float value[4] = {};  ///< r g b a as the sampler sees them
};

/// A level-of-detail record of one lane.
struct LaneLod {
    double rho = 0, lambda = 0, level = 0, frac = 0;
    bool magnified = false;
};

/// One lane's look-up.
struct LaneFootprint {
    LaneLod lod;
    std::vector<TexelTap> taps;  ///< 1 to 8: finer level first, then by row, then by column
};

namespace detail {

template <class T>
LaneLod lane_lod(const LodRecord<Quad<T>>& lod, int lane) {
    return {lod.rho.lane[lane], lod.lambda.lane[lane], lod.level.lane[lane], lod.frac.lane[lane],
            lod.magnified.lane[lane]};
}

inline TexelTap make_tap(const SampledTexture& texture, int level, std::int32_t x, std::int32_t y,
                         bool inside, double weight) {
    TexelTap tap{level, x, y, !inside, weight, {0, 0, 0, 1}};
    const TextureView& view = texture.view;
    const float* texel =
        view.texels + view.offset[level] + (y * view.width[level] + x) * view.channels;
    for (int c = 0; c < view.channels; ++c)
        tap.value[c] = inside ? texel[c] : texture.sampler.border[c];
    return tap;
}

/// Appends the taps of one level for one lane; `share` is the level's weight.
template <class T>
void append_level(const SampledTexture& texture, const vec2<Quad<T>>& uv, int level, Filter filter,
                  int lane, double share, std::vector<TexelTap>& taps) {
    using F = Quad<T>;
    const auto at = address(texture, level_geometry<F>(texture.view, level), uv, filter);
    const auto add = [&](bool second_x, bool second_y, double weight) {
        const auto& x = at.x;
        const auto& y = at.y;
        const bool inside = (second_x ? x.second_inside : x.first_inside).lane[lane] &&
                            (second_y ? y.second_inside : y.first_inside).lane[lane];
        taps.push_back(make_tap(texture, level, (second_x ? x.second : x.first).lane[lane],
                                (second_y ? y.second : y.first).lane[lane], inside,
                                weight * share));
    };
    if (filter == Filter::nearest) return add(false, false, 1);
    const double wx = at.x.weight.lane[lane], wy = at.y.weight.lane[lane];
    add(false, false, (1 - wx) * (1 - wy));
    add(true, false, wx * (1 - wy));
    add(false, true, (1 - wx) * wy);
    add(true, true, wx * wy);
}

}  // namespace detail

/// The footprint of lane `lane` of a two-dimensional look-up at uv with this record.
template <class T>
LaneFootprint lane_footprint(const SampledTexture& texture, const vec2<Quad<T>>& uv,
                             const LodRecord<Quad<T>>& lod, int lane) {
    LaneFootprint footprint{detail::lane_lod(lod, lane), {}};
    const SamplerState& sampler = texture.sampler;
    const Filter filter = footprint.lod.magnified ? sampler.mag : sampler.min;
    const bool mips = sampler.mip != MipFilter::none && texture.view.levels > 1;
    const int finer = mips ? to_int(footprint.lod.level) : 0;
    const double coarse = mips && sampler.mip == MipFilter::linear ? footprint.lod.frac : 0;
    detail::append_level(texture, uv, finer, filter, lane, 1 - coarse, footprint.taps);
    if (coarse > 0)
        detail::append_level(texture, uv, std::min(finer + 1, texture.view.levels - 1), filter,
                             lane, coarse, footprint.taps);
    return footprint;
}

}  // namespace quadrel
