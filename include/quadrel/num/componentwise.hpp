// The functions of common.hpp on vectors, component by component.
#pragma once

#include <type_traits>

#include "quadrel/num/common.hpp"
#include "quadrel/num/vec.hpp"

namespace quadrel {

/// op(a[i], b[i]...) in every component.
template <int size, class F, class Op, class... Vectors>
vec<size, F> map_components(Op op, const vec<size, F>& a, const Vectors&... rest) {
    vec<size, F> result;
    for (int i = 0; i < size; ++i) result[i] = op(a[i], rest[i]...);
    return result;
}

template <int size, Number F>
vec<size, F> abs(const vec<size, F>& v) {
    return map_components([](F x) { return abs(x); }, v);
}
template <int size, Number F>
vec<size, F> floor(const vec<size, F>& v) {
    return map_components([](F x) { return floor(x); }, v);
}
template <int size, Number F>
vec<size, F> ceil(const vec<size, F>& v) {
    return map_components([](F x) { return ceil(x); }, v);
}
template <int size, Number F>
vec<size, F> fract(const vec<size, F>& v) {
    return map_components([](F x) { return fract(x); }, v);
}
template <int size, Number F>
vec<size, F> sign(const vec<size, F>& v) {
    return map_components([](F x) { return sign(x); }, v);
}
template <int size, Number F>
vec<size, F> sqrt(const vec<size, F>& v) {
    return map_components([](F x) { return sqrt(x); }, v);
}
template <int size, Number F>
vec<size, F> saturate(const vec<size, F>& v) {
    return map_components([](F x) { return saturate(x); }, v);
}

template <int size, Number F>
vec<size, F> min(const vec<size, F>& a, const vec<size, F>& b) {
    return map_components([](F x, F y) { return min(x, y); }, a, b);
}
template <int size, Number F>
vec<size, F> min(const vec<size, F>& a, F b) {
    return min(a, vec<size, F>(b));
}
template <int size, Number F>
vec<size, F> max(const vec<size, F>& a, const vec<size, F>& b) {
    return map_components([](F x, F y) { return max(x, y); }, a, b);
}
template <int size, Number F>
vec<size, F> max(const vec<size, F>& a, F b) {
    return max(a, vec<size, F>(b));
}
template <int size, Number F>
vec<size, F> clamp(const vec<size, F>& v, const vec<size, F>& low, const vec<size, F>& high) {
    return min(max(v, low), high);
}
template <int size, Number F>
vec<size, F> clamp(const vec<size, F>& v, F low, F high) {
    return min(max(v, low), high);
}
template <int size, Number F>
vec<size, F> mod(const vec<size, F>& v, const vec<size, F>& y) {
    return map_components([](F a, F b) { return mod(a, b); }, v, y);
}
template <int size, Number F>
vec<size, F> mod(const vec<size, F>& v, F y) {
    return mod(v, vec<size, F>(y));
}

template <int size, Number F>
vec<size, F> mix(const vec<size, F>& a, const vec<size, F>& b, const vec<size, F>& t) {
    return map_components([](F x, F y, F w) { return mix(x, y, w); }, a, b, t);
}
template <int size, Number F>
vec<size, F> mix(const vec<size, F>& a, const vec<size, F>& b, F t) {
    return mix(a, b, vec<size, F>(t));
}
template <int size, Number F>
vec<size, F> lerp(const vec<size, F>& a, const vec<size, F>& b, F t) {
    return map_components([t](F x, F y) { return lerp(x, y, t); }, a, b);
}
template <int size, Number F>
vec<size, F> step(const vec<size, F>& edge, const vec<size, F>& x) {
    return map_components([](F e, F y) { return step(e, y); }, edge, x);
}
template <int size, Number F>
vec<size, F> smoothstep(const vec<size, F>& edge0, const vec<size, F>& edge1,
                        const vec<size, F>& x) {
    return map_components([](F a, F b, F y) { return smoothstep(a, b, y); }, edge0, edge1, x);
}

/// a where m is true, b elsewhere, lane by lane.
template <int size, Number F>
vec<size, F> select(const std::type_identity_t<Mask<F>>& m, const vec<size, F>& a,
                    const vec<size, F>& b) {
    return map_components([m](F x, F y) { return select(m, x, y); }, a, b);
}

}  // namespace quadrel
