// Gradient noise over the plane, and heights made of it: a height field without texels, the same on
// every number type, with its exact gradient.
//
// K. Perlin, "Improving Noise", SIGGRAPH 2002: a gradient at each point of the integer lattice, its
// plane blended with the neighbours' by the quintic 6 t^5 - 15 t^4 + 10 t^3, so that the slope and
// the slope's slope are continuous. Here the gradient is one of eight unit vectors, 45 degrees
// apart, chosen by an integer hash of the lattice point (lowbias32, C. Wellons, "Prospecting for
// Hash Functions", 2018) instead of a table. One octave is within +-sqrt(1/2); times sqrt(2), +-1.
//
//     height(uv) = 1/2 + 1/2 sum over k of 2^-k noise_k(2^k frequency uv) / sum over k of 2^-k
//
// lies in [0, 1]. A whole `frequency` makes it repeat with period 1 in u and v.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "quadrel/texture/counters.hpp"

namespace quadrel {

/// A value at a point of the plane and its gradient there.
template <Number F>
struct NoiseSample {
    F value;
    vec2<F> gradient;
};

// Sums and products wrap around on packets; on plain integers that must be said.
template <class I>
I wrapping_sum(I a, I b) {
    if constexpr (std::is_same_v<I, std::int32_t>)
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) +
                                         static_cast<std::uint32_t>(b));
    else
        return a + b;
}
template <class I>
I wrapping_product(I a, std::uint32_t b) {
    if constexpr (std::is_same_v<I, std::int32_t>)
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * b);
    else
        return a * I(static_cast<std::int32_t>(b));
}

/// The hash of an integer: every input bit changes every output bit about half of the time.
template <Number F>
Int<F> noise_hash(Int<F> x) {
    x = x ^ (shift_right<16>(x) & Int<F>(0xffff));
    x = wrapping_product(x, 0x7feb352du);
    x = x ^ (shift_right<15>(x) & Int<F>(0x1ffff));
    x = wrapping_product(x, 0x846ca68bu);
    return x ^ (shift_right<16>(x) & Int<F>(0xffff));
}

/// The unit gradient of lattice point (x, y) in octave `seed`.
template <Number F>
vec2<F> noise_gradient(Int<F> x, Int<F> y, Int<F> seed) {
    const Int<F> row = noise_hash<F>(wrapping_sum(y, noise_hash<F>(seed)));
    const Int<F> bits = noise_hash<F>(wrapping_sum(x, row));
    const auto bit = [&](std::int32_t mask) { return (bits & Int<F>(mask)) != Int<F>(0); };
    const F diagonal(static_cast<Scalar<F>>(0.70710678118654752));
    const F first = select(bit(1), F(-1), F(1)), second = select(bit(2), F(-1), F(1));
    const F along_u = select(bit(2), F(0), first), along_v = select(bit(2), first, F(0));
    return {select(bit(4), first * diagonal, along_u), select(bit(4), second * diagonal, along_v)};
}

/// The lattice point `i` (whole) and the next, of a lattice that repeats after `period` or never.
template <Number F>
std::array<Int<F>, 2> noise_lattice(F i, bool repeats, F period) {
    if (!repeats) return {to_int(i), to_int(i + F(1))};
    const auto reduced = [period](F x) { return to_int(x - period * floor(x / period)); };
    return {reduced(i), reduced(i + F(1))};
}

/// One octave: noise in [-1, 1] at p, 0 on the lattice's points, with its gradient d / dp. Where it
/// `repeats`, after `period` (whole). Beyond 2^23 a float has no fraction: 0. NaN and infinite p
/// give NaN.
template <Number F>
NoiseSample<F> lattice_noise(const vec2<F>& p, bool repeats, F period, Int<F> seed) {
    const vec2<F> base = floor(p), f = p - base;
    const auto x = noise_lattice(base.x, repeats, period);
    const auto y = noise_lattice(base.y, repeats, period);
    const auto corner = [&](int i, int j) { return noise_gradient<F>(x[i], y[j], seed); };
    const vec2<F> g00 = corner(0, 0), g10 = corner(1, 0), g01 = corner(0, 1), g11 = corner(1, 1);
    const vec2<F> one(F(1)), right(F(1), F(0)), up(F(0), F(1));
    const F a = dot(g00, f), b = dot(g10, f - right), c = dot(g01, f - up), d = dot(g11, f - one);
    const vec2<F> fade = f * f * f * (f * (f * F(6) - vec2<F>(F(15))) + vec2<F>(F(10)));
    const vec2<F> slope = f * f * (f * (f * F(30) - vec2<F>(F(60))) + vec2<F>(F(30)));
    const F low = lerp(a, b, fade.x), high = lerp(c, d, fade.x);
    const vec2<F> planes = lerp(lerp(g00, g10, fade.x), lerp(g01, g11, fade.x), fade.y);
    const vec2<F> blends(slope.x * lerp(b - a, d - c, fade.y), slope.y * (high - low));
    const F scale(static_cast<Scalar<F>>(1.4142135623730951));
    return {lerp(low, high, fade.y) * scale, (planes + blends) * scale};
}

/// The same of one seed, on a lattice that repeats after `period`, or never: 0.
template <Number F>
NoiseSample<F> lattice_noise(const vec2<F>& p, Scalar<F> period, std::int32_t seed) {
    return lattice_noise<F>(p, period != 0, F(period), Int<F>(seed));
}

/// The height field described above: height in [0, 1] and (dh/du, dh/dv). `octaves` is at least 1.
template <Number F>
NoiseSample<F> noise_field(const vec2<F>& uv, float frequency, int octaves) {
    const bool repeats = frequency != 0 && std::floor(frequency) == frequency;
    NoiseSample<F> sum{F(0), vec2<F>(F(0))};
    F cells(static_cast<Scalar<F>>(frequency)), amplitude(1), total(0);
    for (const auto k : steps<F>(0, octaves - 1)) {
        const auto octave = lattice_noise<F>(uv * cells, repeats, cells, to_int(number<F>(k)));
        sum.value = sum.value + octave.value * amplitude;
        sum.gradient = sum.gradient + octave.gradient * (amplitude * cells);
        total = total + amplitude;
        cells = cells * F(2);
        amplitude = amplitude * F(0.5f);
    }
    const F half = F(0.5f) / total;
    return {saturate(F(0.5f) + sum.value * half), sum.gradient * half};
}

/// noise_field as a look-up: counted as one fetch. Noise has no levels of detail.
template <Number F>
NoiseSample<F> noise_fetch(const SampleContext<F>& context, const vec2<F>& uv, float frequency,
                           int octaves) {
    count_fetch(context);
    return noise_field(uv, frequency, octaves);
}

}  // namespace quadrel
