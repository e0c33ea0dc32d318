// The dual cells of a height field: cell (i, j) is the bilinear patch between the centres of texels
// (i, j), (i+1, j), (i, j+1) and (i+1, j+1), so in cell coordinates x = u * width - 1/2,
// y = v * height - 1/2 it is the unit square at (i, j). Beyond the texture the wrap mode goes on:
// a periodic axis repeats its stored cells, on any other axis all cells outside of the stored ones
// equal the outermost one, so that a finite grid stands for the whole plane.
// Wrapping is that of texture/address.hpp.
#pragma once

#include "quadrel/texture/filter.hpp"

namespace quadrel {

/// One axis of a grid over the plane: indices [first, first + count) are stored, every other index
/// stands for one of them.
struct GridAxis {
    std::int32_t first, count;
    bool periodic;  ///< index + count is the same; else indices outside are the outermost stored
};

struct Grid {
    GridAxis u, v;
};

/// The dual cells that `texels` texels have under a wrap mode.
[[gnu::always_inline]] inline GridAxis cell_axis(std::int32_t texels, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return {0, texels, true};
        case Wrap::mirrored_repeat:
            return {0, 2 * texels, true};
        case Wrap::clamp_to_edge:
            return {-1, texels + 1, false};
        case Wrap::clamp_to_border:
            return {-2, texels + 3, false};
        case Wrap::mirror_once:
            break;
    }
    return {-texels - 1, 2 * texels + 1, false};
}

/// The texels themselves as such a grid: mirrored axes store the image as well, an axis with a
/// border one texel of it at either end.
inline GridAxis texel_axis(std::int32_t texels, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return {0, texels, true};
        case Wrap::mirrored_repeat:
            return {0, 2 * texels, true};
        case Wrap::clamp_to_edge:
            return {0, texels, false};
        case Wrap::clamp_to_border:
            return {-1, texels + 2, false};
        case Wrap::mirror_once:
            break;
    }
    return {-texels, 2 * texels, false};
}

inline Grid cell_grid(std::int32_t width, std::int32_t height, const SamplerState& sampler) {
    return {cell_axis(width, sampler.wrap_u), cell_axis(height, sampler.wrap_v)};
}

inline Grid texel_grid(std::int32_t width, std::int32_t height, const SamplerState& sampler) {
    return {texel_axis(width, sampler.wrap_u), texel_axis(height, sampler.wrap_v)};
}

/// Whether n is 2^k, k in [0, 30].
constexpr bool is_power_of_two(std::int32_t n) { return n > 0 && (n & (n - 1)) == 0; }

/// Remainder of dividing by a positive n, in [0, n). |i| at most 2^24 if F has float's precision.
template <Number F>
[[gnu::always_inline]] inline Int<F> floor_mod(Int<F> i, std::int32_t n) {
    if (is_power_of_two(n)) return i & Int<F>(n - 1);
    const Int<F> period(n);
    const F turns = floor(to_float<F>(i) * F(Scalar<F>(1) / static_cast<Scalar<F>>(n)));
    const Int<F> rest = i - to_int_in_range(turns) * period;
    // Two roundings: by less than 1 / n where |i| < 2^23, so that the quotient of a multiple of n
    // may fall short of it and nothing else; beyond, it may be off by one.
    const Int<F> raised = select(rest < Int<F>(0), rest + period, rest);
    return select(raised >= period, raised - period, raised);
}

/// Where index i (of a cell or texel anywhere in the plane) is stored: [0, count). For periodic
/// axes |i| is at most 2^24 if F has float's precision.
template <Number F>
[[gnu::always_inline]] inline Int<F> stored_index(Int<F> i, const GridAxis& axis) {
    const Int<F> from_first = i - Int<F>(axis.first);
    if (axis.periodic) return floor_mod<F>(from_first, axis.count);
    return min(max(from_first, Int<F>(0)), Int<F>(axis.count - 1));
}

/// The two texels of one axis between which a cell lies.
template <Number F>
struct CellTexels {
    Int<F> first, second;                 ///< in [0, texels)
    Mask<F> first_inside, second_inside;  ///< false: the border colour (clamp_to_border only)
};

/// The texels of a stored cell; `stored` is in [0, axis.count).
template <Number F>
[[gnu::always_inline]] inline CellTexels<F> cell_texels(Int<F> stored, const GridAxis& axis,
                                                        std::int32_t texels, Wrap wrap) {
    const Int<F> first = stored + Int<F>(axis.first);
    const Int<F> second = first + Int<F>(1);
    const Int<F> n(texels);
    if (wrap == Wrap::repeat)  // `first` is a texel's index
        return {first, select(second == n, Int<F>(0), second), Mask<F>(true), Mask<F>(true)};
    return {wrap_index<F>(first, n, wrap), wrap_index<F>(second, n, wrap),
            inside_level<F>(first, n, wrap), inside_level<F>(second, n, wrap)};
}

/// Channel 0 of a texel of `level`: column x, row y, all within the map.
template <Number F>
[[gnu::always_inline]] inline F first_channel(const TextureView& view, Int<F> x, Int<F> y,
                                              Int<F> level) {
    const Int<F> texel = y * gather_int<F>(view.width, level) + x;
    return gather<F>(view.texels,
                     gather_int<F>(view.offset, level) + texel * Int<F>(view.channels));
}
/// The same of level 0.
template <Number F>
[[gnu::always_inline]] inline F first_channel(const TextureView& view, Int<F> x, Int<F> y) {
    const Int<F> texel = y * Int<F>(view.width[0]) + x;
    return gather<F>(view.texels + view.offset[0], texel * Int<F>(view.channels));
}

/// Heights at the corners of a cell.
template <Number F>
struct CellHeights {
    F h00, h10, h01, h11;  ///< at (i, j), (i+1, j), (i, j+1), (i+1, j+1)
};

/// Corner heights (channel 0 of level 0; outside of a border its first component) of stored cell
/// (i, j), both in [0, count) of their axis. `cells` is cell_grid of level 0.
template <Number F>
CellHeights<F> cell_heights(const SampledTexture& texture, const Grid& cells, Int<F> i, Int<F> j) {
    const TextureView& view = texture.view;
    const SamplerState& sampler = texture.sampler;
    const auto x = cell_texels<F>(i, cells.u, view.width[0], sampler.wrap_u);
    const auto y = cell_texels<F>(j, cells.v, view.height[0], sampler.wrap_v);
    // Two neighbours in memory come by one look-up.
    const bool adjacent = view.channels == 1 && all(x.second == x.first + Int<F>(1));
    const auto row = [&](Int<F> number, Mask<F> inside) {
        F pair[2];
        if (adjacent) {
            gather2<F>(view.texels + view.offset[0], number * Int<F>(view.width[0]) + x.first,
                       pair);
        } else {
            pair[0] = first_channel<F>(view, x.first, number);
            pair[1] = first_channel<F>(view, x.second, number);
        }
        if (!has_border(sampler)) return vec2<F>(pair[0], pair[1]);
        const F border(sampler.border[0]);
        return vec2<F>(select(x.first_inside & inside, pair[0], border),
                       select(x.second_inside & inside, pair[1], border));
    };
    const vec2<F> low = row(y.first, y.first_inside), high = row(y.second, y.second_inside);
    return {low.x, low.y, high.x, high.y};
}

/// Both channels of a texel of level 0 of a map of two.
template <Number F>
[[gnu::always_inline]] inline vec2<F> both_channels(const TextureView& view, Int<F> x, Int<F> y) {
    F channel[2];
    const Int<F> texel = y * Int<F>(view.width[0]) + x;
    gather2<F>(view.texels + view.offset[0], texel + texel, channel);
    return {channel[0], channel[1]};
}
/// All channels of a texel of `level`; those that the map lacks are 1.
template <Number F>
vec4<F> all_channels(const TextureView& view, Int<F> x, Int<F> y, Int<F> level) {
    const Int<F> texel = y * gather_int<F>(view.width, level) + x;
    const Int<F> first = gather_int<F>(view.offset, level) + texel * Int<F>(view.channels);
    F channel[4] = {F(1), F(1), F(1), F(1)};
    if (view.channels == 1) channel[0] = gather<F>(view.texels, first);
    if (view.channels > 1) gather2<F>(view.texels, first, channel);
    if (view.channels == 4) gather2<F>(view.texels, first + Int<F>(2), channel + 2);
    return {channel[0], channel[1], channel[2], channel[3]};
}
/// Texel `index` of a map of one channel, counted over all levels.
template <Number F>
[[gnu::always_inline]] inline F only_channel(const TextureView& view, Int<F> index) {
    return gather<F>(view.texels, index);
}

}  // namespace quadrel
