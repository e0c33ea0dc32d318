// The table of built-ins: one overload set for every number type, with every order of operations
// written down. "Bit for bit a listing" means the listing over this table.
//
// None of these branches on lane values; all are exact compositions of the IEEE operations + - * /
// sqrt, so every float type and instruction set gives the same bits.
#pragma once

#include "quadrel/num/packet.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/num/vec.hpp"

namespace quadrel {

// ---- Compare-and-select: NaN and -0 follow from the comparison as written
// -------------------------

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

// ---- GLSL's scalar functions
// ----------------------------------------------------------------------

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

// ---- Vectors: sums left to right
// ------------------------------------------------------------------

/// x, then y, then z.
template <Number F>
F dot(const vec2<F>& a, const vec2<F>& b) {
    return a.x * b.x + a.y * b.y;
}
template <Number F>
F dot(const vec3<F>& a, const vec3<F>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <Number F>
F dot(const vec4<F>& a, const vec4<F>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
/// (ay bz - by az, az bx - bz ax, ax by - bx ay).
template <Number F>
vec3<F> cross(const vec3<F>& a, const vec3<F>& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <class V>
auto length(const V& v) -> decltype(dot(v, v)) {
    return sqrt(dot(v, v));
}
template <class V>
auto distance(const V& a, const V& b) -> decltype(dot(a, b)) {
    return length(a - b);
}
/// v * (1 / sqrt(dot(v, v))); a null vector gives NaN.
template <Number F>
vec2<F> normalize(const vec2<F>& v) {
    return v * (F(1) / sqrt(dot(v, v)));
}
template <Number F>
vec3<F> normalize(const vec3<F>& v) {
    return v * (F(1) / sqrt(dot(v, v)));
}
/// i - n * (dot(n, i) * 2).
template <Number F>
vec3<F> reflect(const vec3<F>& i, const vec3<F>& n) {
    return i - n * (dot(n, i) * F(2));
}
/// k = 1 - eta * eta * (1 - dot(n, i)^2); 0 when k < 0, else eta * i - n * (eta * dot(n, i) +
/// sqrt(k)).
template <Number F>
vec3<F> refract(const vec3<F>& i, const vec3<F>& n, F eta) {
    const F cosine = dot(n, i);
    const F k = F(1) - eta * eta * (F(1) - cosine * cosine);
    const vec3<F> bent = i * eta - n * (eta * cosine + sqrt(k));
    return select(k < F(0), vec3<F>(F(0)), bent);
}
/// dot(reference, i) < 0 ? n : -n.
template <Number F>
vec3<F> faceforward(const vec3<F>& n, const vec3<F>& i, const vec3<F>& reference) {
    return select(dot(reference, i) < F(0), n, -n);
}

template <Number F>
vec2<F> select(Mask<F> m, const vec2<F>& a, const vec2<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y)};
}
template <Number F>
vec3<F> select(Mask<F> m, const vec3<F>& a, const vec3<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <Number F>
vec4<F> select(Mask<F> m, const vec4<F>& a, const vec4<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
template <Number F>
vec3<F> mix(const vec3<F>& a, const vec3<F>& b, F t) {
    return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}

}  // namespace quadrel
