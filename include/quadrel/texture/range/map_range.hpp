// What a map may give anywhere in ranges of coordinates and of levels. What is too much to look
// through is all that the map holds.
#pragma once

#include "quadrel/texture/range/footprint.hpp"

namespace quadrel::range_detail {

/// The least and the greatest of all levels and faces, and of the border. Remembered: a thread asks
/// for few maps.
inline const TexelRange& whole_map(const SampledTexture& texture) {
    struct Known {
        const float* texels;
        std::uint64_t maps;
        TexelRange range;
    };
    constexpr int kept = 32;
    static thread_local Known known[kept];
    static thread_local int next = 0;
    const TextureView& view = texture.view;
    const std::uint64_t maps = range_context().maps;
    for (const Known& entry : known)
        if (entry.texels == view.texels && entry.maps == maps) return entry.range;
    Known& entry = known[next++ % kept];
    entry.range = TexelRange::nothing();
    for (int l = 0; l < view.levels; ++l) {
        const float* texel = view.texels + view.offset[l];
        const std::int64_t count = std::int64_t{view.width[l]} * view.height[l] * view.faces;
        for (std::int64_t i = 0; i < count; ++i, texel += view.channels) {
            double value[4] = {0, 0, 0, 1};
            for (int c = 0; c < view.channels; ++c) value[c] = texel[c];
            entry.range.include(value);
        }
    }
    double border[4] = {0, 0, 0, 1};
    for (int c = 0; c < view.channels; ++c) border[c] = texture.sampler.border[c];
    if (has_border(texture.sampler)) entry.range.include(border);
    entry.texels = view.texels;
    entry.maps = maps;
    return entry.range;
}

/// What a level's filter may give over ranges of coordinates, in units of the texture.
inline TexelRange level_range(const SampledTexture& texture, int level, Filter filter,
                              const Ranged& u, const Ranged& v) {
    if (!u.is_bounded() || !v.is_bounded()) return whole_map(texture);
    const LevelTexels texels(texture, level);
    const RealInterval x = texel_coordinates(u.range(), texels.width(), texture.sampler);
    const RealInterval y = texel_coordinates(v.range(), texels.height(), texture.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2) return whole_map(texture);
    TexelRange range = TexelRange::nothing();
    const bool done = filter == Filter::linear ? include_linear(range, texels, x, y)
                                               : include_nearest(range, texels, x, y);
    return done ? range : whole_map(texture);
}

/// a + t (b - a) for t in a range within [0, 1].
inline TexelRange blended(const TexelRange& a, const TexelRange& b, const RealInterval& t) {
    TexelRange result;
    for (int c = 0; c < 4; ++c) {
        const auto at = [&](double weight, double low, double high) {
            return low + weight * (high - low);
        };
        const double lows[2] = {at(t.lo, a.channel[c].lo, b.channel[c].lo),
                                at(t.hi, a.channel[c].lo, b.channel[c].lo)};
        const double highs[2] = {at(t.lo, a.channel[c].hi, b.channel[c].hi),
                                 at(t.hi, a.channel[c].hi, b.channel[c].hi)};
        result.channel[c] = {std::min(lows[0], lows[1]), std::max(highs[0], highs[1])};
    }
    return result;
}

/// The levels that a range of d, in [0, levels - 1], may select.
template <class LevelRange>
TexelRange range_of_levels(MipFilter mip, const RealInterval& d, const LevelRange& level) {
    TexelRange range = TexelRange::nothing();
    if (mip == MipFilter::none) return level(0);
    if (mip == MipFilter::nearest) {
        for (double l = std::ceil(d.lo + 0.5) - 1; l <= std::floor(d.hi + 0.5); ++l)
            range.include(level(static_cast<int>(l)));
        return range;
    }
    TexelRange fine = level(static_cast<int>(d.lo));
    for (double l = std::floor(d.lo); l <= d.hi; ++l) {
        const RealInterval weight = weights_in(d, l);
        if (weight.hi == 0) {
            range.include(fine);
            break;
        }
        const TexelRange coarse = level(static_cast<int>(l) + 1);
        range.include(blended(fine, coarse, weight));
        fine = coarse;
    }
    return range;
}

}  // namespace quadrel::range_detail
