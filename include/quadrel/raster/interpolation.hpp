// Attribute interpolation from edge values, lane by lane, over any number type.
//
// With edge values e_i, clip w_i and values v_i at the three vertices, q_i = e_i / w_i and
// s = q_0 + q_1 + q_2, the perspective-correct value is sum(q_i v_i) / s (Vulkan, "Basic Polygon
// Rasterization"). Helper lanes evaluate the same text outside of the triangle: their e_i are
// partly negative, s can vanish or change its sign, and the value may be huge or NaN; nothing
// traps.
//
// Error. Let u be the unit roundoff (2^-24 in float), v^ the computed value and v the exact one of
// the same w_i and v_i, with integer e_i rounded to F. Then
//
//     |v^ - v| <= c u kappa sum|q_i v_i| / |s|,   kappa = sum|q_i| / |s|,   c = 11,
//
// as long as nothing under- or overflows and u kappa < 1/64. On covered lanes kappa = 1.
// Derivation: a computed q_i has two roundings (e_i to F, the division), s two more (the
// additions), so s^ = s (1 + t), |t| <= 4 u kappa to first order. The product of b_i^ = q_i^ / s^
// and v_i adds two roundings and the sum two, so v^ = sum(q_i v_i (1 + t_i)) / s^ with |t_i| <= 6u.
// Hence |v^ - v| <= (6u sum|q_i v_i| + 4 u kappa |v| |s|) / |s^|, and |v s| <= sum|q_i v_i|: 10 u
// kappa to first order; the eleventh covers the rest. Noperspective values are the case w_i = 1.
#pragma once

#include "quadrel/num/functions.hpp"

namespace quadrel {

/// The constant c above.
inline constexpr double interpolation_error_factor = 11;

/// One F for each vertex of the triangle: edge values, clip w, an attribute, or barycentrics.
template <class F>
struct PerVertex {
    F v0, v1, v2;
};

/// v0, then v1, then v2.
template <Number F>
F sum(const PerVertex<F>& a) {
    return a.v0 + a.v1 + a.v2;
}

/// Barycentric coordinates in the window (for noperspective values): e_i / (e_0 + e_1 + e_2).
template <Number F>
PerVertex<F> window_barycentrics(const PerVertex<F>& e) {
    const F area = sum(e);
    return {e.v0 / area, e.v1 / area, e.v2 / area};
}

/// Perspective-correct barycentric coordinates: (e_i / w_i) / sum(e_j / w_j).
template <Number F>
PerVertex<F> perspective_barycentrics(const PerVertex<F>& e, const PerVertex<F>& w) {
    return window_barycentrics(PerVertex<F>{e.v0 / w.v0, e.v1 / w.v1, e.v2 / w.v2});
}

/// b_0 v_0 + b_1 v_1 + b_2 v_2, in this order, for a scalar or a vector over F.
template <Number F>
F interpolate(const PerVertex<F>& b, const PerVertex<F>& value) {
    return b.v0 * value.v0 + b.v1 * value.v1 + b.v2 * value.v2;
}
template <glm::length_t n, Number F>
glm::vec<n, F, glm::defaultp> interpolate(const PerVertex<F>& b,
                                          const PerVertex<glm::vec<n, F, glm::defaultp>>& value) {
    glm::vec<n, F, glm::defaultp> result;
    for (glm::length_t i = 0; i < n; ++i)
        result[i] = interpolate(b, PerVertex<F>{value.v0[i], value.v1[i], value.v2[i]});
    return result;
}

/// Clip w at the lane: the perspective-correct w, (e_0 + e_1 + e_2) / sum(e_i / w_i).
template <Number F>
F interpolate_w(const PerVertex<F>& e, const PerVertex<F>& w) {
    return sum(e) / sum(PerVertex<F>{e.v0 / w.v0, e.v1 / w.v1, e.v2 / w.v2});
}

/// Which vertex of the original primitive gives flat values.
enum class ProvokingVertex : std::int32_t { first = 0, last = 2 };

/// A flat value: the provoking vertex's own bits.
template <class T>
T flat(const PerVertex<T>& value, ProvokingVertex provoking = ProvokingVertex::first) {
    return provoking == ProvokingVertex::first ? value.v0 : value.v2;
}

}  // namespace quadrel
