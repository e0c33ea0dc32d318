// Texel addressing: a normalised coordinate of one axis becomes two texel indices and a weight.
// Sources: Vulkan specification, "Texel Input Coordinate Systems", "Wrapping Operation"; Direct3D
// 11.3 functional specification 7.18.6 (range reduction) to 7.18.9.
//
// The helpers of a bilinear fetch are inlined by attribute: GCC otherwise passes packets through
// memory, a sixth of the time of a fetch.
#pragma once

#include "quadrel/texture/counters.hpp"
#include "quadrel/texture/format.hpp"

namespace quadrel {

/// Coordinates saturate here, in units of the texture as well as in texels: beyond, a float32 has
/// no fraction bits left.
inline constexpr float coordinate_limit = 8388608.0f;  // 2^23

/// Where one axis of a look-up falls in a level of n texels.
template <Number F>
struct AxisTaps {
    Int<F> first, second;                 ///< in [0, n - 1]; nearest filtering uses `first` alone
    Mask<F> first_inside, second_inside;  ///< false: the border colour (clamp_to_border only)
    F weight;                             ///< of the second tap, [0, 1)
};

inline bool is_periodic(Wrap wrap) { return wrap == Wrap::repeat || wrap == Wrap::mirrored_repeat; }

/// NaN becomes 0 and magnitudes beyond the limit saturate.
template <Number F>
[[gnu::always_inline]] inline F saturate_coordinate(F u) {
    const F limit(coordinate_limit);
    return select(abs(u) <= limit, u, select(is_nan(u), F(0), copysign(limit, u)));
}

/// The part of u in [0, 1): u - floor(u), and 0 for what rounds up to 1, is not a number, or is
/// beyond the limit.
template <Number F>
[[gnu::always_inline]] inline F reduce_coordinate(F u) {
    const F known = select(abs(u) <= F(coordinate_limit), u, F(0));
    const F part = known - floor(known);
    return select(part < F(1), part, F(0));
}

/// Texel coordinate (texel centres at .5) of normalised u in a level of `size` texels, bounded so
/// that every later step is exact: periodic modes are reduced before they are scaled unless the
/// sampler says otherwise; the others saturate just outside of what they can tell apart.
template <Number F>
[[gnu::always_inline]] inline F texel_coordinate(F u, F size, Wrap wrap, bool scale_first) {
    if (wrap == Wrap::repeat && !scale_first) return reduce_coordinate(u) * size;
    if (wrap == Wrap::mirrored_repeat && !scale_first) {
        return reduce_coordinate(u * F(0.5f)) * F(2) * size;
    }
    const F scaled = saturate_coordinate(u) * size;
    if (is_periodic(wrap)) return saturate_coordinate(scaled);
    const F outside = size + F(2);
    return clamp(scaled, -outside, outside);
}

/// Rounds to `bits` fraction bits, halves to even, as fixed-point samplers do before they split
/// the coordinate. 0 bits: exact.
template <Number F>
[[gnu::always_inline]] inline F round_to_bits(F x, std::int32_t bits) {
    if (bits == 0) return x;
    const float scale = static_cast<float>(std::int64_t(1) << bits);
    return round_even(x * F(scale)) * F(1 / scale);
}

/// Brings an integer-valued texel index of a periodic mode to within one period of the level.
template <Number F>
F reduce_index(F index, F size, Wrap wrap) {
    const F period = wrap == Wrap::repeat ? size : size + size;
    return index - period * floor(index / period);
}

/// -(1 + i) for negative i: reflection at the edge between texels -1 and 0.
template <Number F>
Int<F> mirror_index(Int<F> i) {
    return select(i < Int<F>(0), Int<F>(-1) - i, i);
}

/// The texel that index i stands for in a level of n texels. Periodic modes take i at most one
/// period outside, clamp_to_border gives the edge texel.
template <Number F>
[[gnu::always_inline]] inline Int<F> wrap_index(Int<F> i, Int<F> n, Wrap wrap) {
    const Int<F> zero(0);
    if (wrap == Wrap::repeat) {
        const Int<F> raised = select(i < zero, i + n, i);
        return select(raised >= n, raised - n, raised);
    }
    if (wrap == Wrap::mirrored_repeat) {
        const Int<F> period = n + n;
        const Int<F> raised = select(i < zero, i + period, i);
        const Int<F> phase = select(raised >= period, raised - period, raised);
        return select(phase >= n, period - Int<F>(1) - phase, phase);
    }
    const Int<F> index = wrap == Wrap::mirror_once ? mirror_index<F>(i) : i;
    return min(max(index, zero), n - Int<F>(1));
}

template <Number F>
[[gnu::always_inline]] inline Mask<F> inside_level(Int<F> i, Int<F> n, Wrap wrap) {
    if (wrap != Wrap::clamp_to_border) return Mask<F>(true);
    return (i >= Int<F>(0)) & (i < n);
}

/// Splits a texel coordinate, which is within the limit, into texels and weight.
template <Number F>
[[gnu::always_inline]] inline AxisTaps<F> split_coordinate(F texel, Int<F> n, F size, Wrap wrap,
                                                           Filter filter,
                                                           const SamplerState& sampler) {
    const F rounded = round_to_bits(texel, sampler.weight_bits);
    const F shifted = filter == Filter::linear ? rounded - F(0.5f) : rounded;
    const F base = floor(shifted);
    const bool reduce = sampler.scale_first != 0 && is_periodic(wrap);
    const Int<F> first = to_int_in_range(reduce ? reduce_index(base, size, wrap) : base);
    const Int<F> second = first + Int<F>(1);
    return {wrap_index<F>(first, n, wrap), wrap_index<F>(second, n, wrap),
            inside_level<F>(first, n, wrap), inside_level<F>(second, n, wrap), shifted - base};
}

/// The texels of normalised coordinate u in a level of n texels (`size` is n as a number).
template <Number F>
[[gnu::always_inline]] inline AxisTaps<F> address_axis(F u, Int<F> n, F size, Wrap wrap,
                                                       Filter filter, const SamplerState& sampler) {
    const F texel = texel_coordinate(u, size, wrap, sampler.scale_first != 0);
    return split_coordinate(texel, n, size, wrap, filter, sampler);
}

}  // namespace quadrel
