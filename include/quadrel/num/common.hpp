// GLSL's common functions (GLSL 4.60 specification, 8.3) on numbers, with every order of operations
// written down. None branches on lane values; all are exact compositions of + - * / sqrt and
// comparisons, so every float type and instruction set gives the same bits.
#pragma once

#include <limits>

#include "quadrel/num/packet.hpp"
#include "quadrel/num/quad.hpp"

namespace quadrel {

// ---- Compare-and-select: NaN and -0 follow from the comparison as written -----------------------

/// b < a ? b : a. A NaN in either operand gives a; min(-0, 0) is -0, min(0, -0) is 0.
template <Number F>
F min(F a, F b) {
    return select(b < a, b, a);
}
/// a < b ? b : a. A NaN in either operand gives a.
template <Number F>
F max(F a, F b) {
    return select(a < b, b, a);
}
/// min(max(x, low), high); NaN stays NaN.
template <Number F>
F clamp(F x, F low, F high) {
    return min(max(x, low), high);
}
/// clamp to [0, 1]; NaN stays NaN.
template <Number F>
F saturate(F x) {
    return clamp(x, F(0), F(1));
}
template <Number F>
Mask<F> is_nan(F x) {
    return x != x;
}
/// Neither infinite nor NaN.
template <Number F>
Mask<F> is_finite(F x) {
    return abs(x) <= F(std::numeric_limits<Scalar<F>>::max());
}

// ---- Arithmetic ---------------------------------------------------------------------------------

/// -1, 0 or 1; 0 for NaN.
template <Number F>
F sign(F x) {
    return select(x > F(0), F(1), select(x < F(0), F(-1), F(0)));
}
/// x - floor(x). Rounds up to 1 for tiny negative x, as GLSL allows.
template <Number F>
F fract(F x) {
    return x - floor(x);
}
/// x - y * floor(x / y).
template <Number F>
F mod(F x, F y) {
    return x - y * floor(x / y);
}
/// a * (1 - t) + b * t.
template <Number F>
F mix(F a, F b, F t) {
    return a * (F(1) - t) + b * t;
}
/// a + t * (b - a): the form of texture filters; a constant stays itself.
template <Number F>
F lerp(F a, F b, F t) {
    return a + t * (b - a);
}
/// x < edge ? 0 : 1.
template <Number F>
F step(F edge, F x) {
    return select(x < edge, F(0), F(1));
}
/// t * t * (3 - 2 * t) of t = saturate((x - edge0) / (edge1 - edge0)).
template <Number F>
F smoothstep(F edge0, F edge1, F x) {
    const F t = saturate((x - edge0) / (edge1 - edge0));
    return t * t * (F(3) - F(2) * t);
}
/// 1 / sqrt(x), both rounded.
template <Number F>
F inversesqrt(F x) {
    return F(1) / sqrt(x);
}

}  // namespace quadrel
