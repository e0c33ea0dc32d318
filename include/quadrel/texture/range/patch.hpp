// Values and slopes of a bilinear patch on ranges: of every patch that a place may be in, by the
// place in it.
//
// Which patch a gather reads and which weights a text makes of the same coordinates may differ by a
// rounding: where a place may be on a border, any weight goes with either patch.
#pragma once

#include "quadrel/texture/range/sampler.hpp"

namespace quadrel::range_detail {

/// What a channel of level 0 and its slopes, a texel, may be.
struct PatchRange {
    RealInterval value, x, y;
};

/// Over ranges of coordinates; of more than a few patches, what the whole map allows.
inline PatchRange patch_range(const SampledTexture& map, int channel, const Ranged& u,
                              const Ranged& v) {
    const LevelTexels level(map, 0);
    const RealInterval all = whole_map(map).channel[channel];
    const RealInterval steepest(-all.width(), all.width());
    const PatchRange unknown{all, steepest, steepest};
    if (!u.is_bounded() || !v.is_bounded()) return unknown;
    const RealInterval x = texel_coordinates(u.range(), level.width(), map.sampler);
    const RealInterval y = texel_coordinates(v.range(), level.height(), map.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2) return unknown;
    const RealInterval column(std::floor(x.lo - 0.5), std::floor(x.hi - 0.5));
    const RealInterval row(std::floor(y.lo - 0.5), std::floor(y.hi - 0.5));
    if (!((column.width() + 1) * (row.width() + 1) <= most_patches)) return unknown;
    const auto weights = [](const RealInterval& at, const RealInterval& cells) {
        return cells.is_point() ? RealInterval(at.lo - 0.5 - cells.lo, at.hi - 0.5 - cells.lo)
                                : RealInterval(0, 1);
    };
    const RealInterval f = weights(x, column), g = weights(y, row);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PatchGradients slopes;
    for (int c = 0; c < 4; ++c) slopes.x[c] = slopes.y[c] = {infinity, -infinity};
    TexelRange values = TexelRange::nothing();
    for (double j = row.lo; j <= row.hi; ++j)
        for (double i = column.lo; i <= column.hi; ++i) {
            if (!include_gradients(slopes, level, i, j, f, g)) return unknown;
            include_patch(values, level, i, j, f, g);
        }
    // Differences and interpolations of texels.
    const RealInterval value = values.channel[channel];
    const double off =
        (budget().unit > 0 ? 8 * budget().unit : 0x1p-48) *
        (value.magnitude() + slopes.x[channel].magnitude() + slopes.y[channel].magnitude());
    return {widened(value, off), widened(slopes.x[channel], off), widened(slopes.y[channel], off)};
}

/// Of each lane of `active`; elsewhere anything.
struct PatchRanges {
    Ranges value = Ranges(Ranged::anything());
    vec2<Ranges> slope = vec2<Ranges>(Ranges(Ranged::anything()));  ///< a texel

    PatchRanges(const SampledTexture& map, const SampleContext<Ranges>& context,
                const vec2<Ranges>& uv, int channel) {
        for (int i = 0; i < 4; ++i) {
            if (!asks(context, i)) continue;
            const PatchRange patch = patch_range(map, channel, uv.x.lane[i], uv.y.lane[i]);
            value.lane[i] = Ranged(patch.value);
            slope.x.lane[i] = Ranged(patch.x);
            slope.y.lane[i] = Ranged(patch.y);
        }
    }
};

}  // namespace quadrel::range_detail
