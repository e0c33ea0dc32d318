// GLSL's geometric functions (GLSL 4.60 specification, 8.5); sums are added left to right.
#pragma once

#include "quadrel/num/componentwise.hpp"

namespace quadrel {

/// x, then y, then z, then w.
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
/// sqrt(dot(v, v)).
template <int size, Number F>
F length(const vec<size, F>& v) {
    return sqrt(dot(v, v));
}
/// length(a - b).
template <int size, Number F>
F distance(const vec<size, F>& a, const vec<size, F>& b) {
    return length(a - b);
}
/// v * (1 / sqrt(dot(v, v))); a null vector gives NaN.
template <int size, Number F>
vec<size, F> normalize(const vec<size, F>& v) {
    return v * inversesqrt(dot(v, v));
}
/// i - n * (dot(n, i) * 2).
template <int size, Number F>
vec<size, F> reflect(const vec<size, F>& i, const vec<size, F>& n) {
    return i - n * (dot(n, i) * F(2));
}
/// k = 1 - eta * eta * (1 - dot(n, i)^2); 0 when k < 0, else i * eta - n * (eta * dot(n, i) +
/// sqrt(k)).
template <int size, Number F>
vec<size, F> refract(const vec<size, F>& i, const vec<size, F>& n, F eta) {
    const F cosine = dot(n, i);
    const F k = F(1) - eta * eta * (F(1) - cosine * cosine);
    const vec<size, F> bent = i * eta - n * (eta * cosine + sqrt(k));
    return select(k < F(0), vec<size, F>(F(0)), bent);
}
/// dot(reference, i) < 0 ? n : -n.
template <int size, Number F>
vec<size, F> faceforward(const vec<size, F>& n, const vec<size, F>& i,
                         const vec<size, F>& reference) {
    return select(dot(reference, i) < F(0), n, -n);
}

}  // namespace quadrel
