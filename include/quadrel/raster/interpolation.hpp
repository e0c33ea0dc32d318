// Attribute interpolation from edge values, lane by lane, over any number type, each value within a
// rounding of the exact one.
//
// With edge values e_i, clip w_i and values v_i at the three vertices, q_i = e_i w_j w_k (j, k the
// other two vertices: e_i / w_i times what all three share), s = q_0 + q_1 + q_2 and b_i = q_i / s,
// the perspective-correct value is sum(b_i v_i) (Vulkan, "Basic Polygon Rasterization"), evaluated
// as v_0 + b_1 (v_1 - v_0) + b_2 (v_2 - v_0) in double and rounded once to F. Values that are equal
// at all vertices stay that value, bit for bit. Helper lanes evaluate the same text outside of the
// triangle: their e_i are partly negative, s can vanish or change its sign, and the value may be
// huge or NaN; nothing traps.
//
// Error. Let v be the exact value of the same w_i, v_i (floats) and integer e_i, M = max|v_i| and
// kappa = sum|q_i| / |s|, which is 1 on covered lanes. Then the computed value v^ is within
//
//     |v^ - v| <= (0.51 ulp(v) + 2^-48 M) kappa     in float, and
//     |v^ - v| <= 2^-48 (|v| + M) kappa             in double,
//
// as long as nothing overflows and kappa < 2^40. Derivation, u = 2^-53, to first order: q_i has two
// roundings (e_i to double, the product; w_j w_k is exact), which moves the weighted mean by at
// most 2u kappa (M + |v|). The roundings of s and 1/s are shared by b_1 and b_2: (2 kappa + 2) u of
// |v - v_0| <= M + |v|. The product q_i (1/s), the difference of the values and the product with it
// are 3u of |b_i (v_i - v_0)|, summed at most 6u kappa M; the two sums are at most 3u kappa M and
// u |v|. Together 15u kappa M + 7u kappa |v|, and |v| < 2^24 ulp(v).
#pragma once

#include "quadrel/num/functions.hpp"
#include "quadrel/num/packet.hpp"

namespace quadrel {

/// The constants above: parts of an ulp of the result, and of max|v_i|.
inline constexpr double interpolation_ulps = 0.51;
inline constexpr double interpolation_unit = 0x1p-48;

/// One F for each vertex of the triangle: an attribute, clip w, or edge values.
template <class F>
struct PerVertex {
    F v0, v1, v2;
};

/// Edge values at the lanes: any positive multiple of them serves.
template <Number F>
using EdgeValues = PerVertex<Wide<F>>;

/// Derivatives of the three edge functions in window x and y, per pixel, by the same multiple:
/// they are linear, so that these hold anywhere.
struct EdgeSlopes {
    double dx[3], dy[3];
};

/// v0, then v1, then v2.
template <class F>
F sum(const PerVertex<F>& a) {
    return a.v0 + a.v1 + a.v2;
}

/// Weights of the three vertices in a lane: sum 1.
template <Number F>
struct Barycentrics {
    Wide<F> b0, b1, b2;
};

/// For noperspective values: e_i / (e_0 + e_1 + e_2).
template <Number F>
Barycentrics<F> window_barycentrics(const EdgeValues<F>& e) {
    const Wide<F> r = Wide<F>(1.0) / sum(e);
    return {e.v0 * r, e.v1 * r, e.v2 * r};
}

/// Edge values times the w of the other two vertices: e_i / w_i but for a common factor.
template <Number F>
EdgeValues<F> perspective_edges(const EdgeValues<F>& e, const PerVertex<F>& w) {
    const Wide<F> w0 = to_wide(w.v0), w1 = to_wide(w.v1), w2 = to_wide(w.v2);
    return {e.v0 * (w1 * w2), e.v1 * (w2 * w0), e.v2 * (w0 * w1)};
}

/// Perspective-correct: (e_i / w_i) / sum(e_j / w_j).
template <Number F>
Barycentrics<F> perspective_barycentrics(const EdgeValues<F>& e, const PerVertex<F>& w) {
    return window_barycentrics<F>(perspective_edges(e, w));
}
/// The same where all lanes are of one triangle.
template <Packet F>
Barycentrics<F> perspective_barycentrics_of_one(const EdgeValues<F>& e, const PerVertex<float>& w) {
    const double w0 = w.v0, w1 = w.v1, w2 = w.v2;
    return window_barycentrics<F>(
        {e.v0 * Wide<F>(w1 * w2), e.v1 * Wide<F>(w2 * w0), e.v2 * Wide<F>(w0 * w1)});
}

/// The value in a lane, of a scalar or a vector over F.
template <Number F>
F interpolate(const Barycentrics<F>& b, const PerVertex<F>& value) {
    const Wide<F> v0 = to_wide(value.v0);
    const F mixed =
        from_wide<F>(v0 + b.b1 * (to_wide(value.v1) - v0) + b.b2 * (to_wide(value.v2) - v0));
    // Keeps -0, infinities, and constants where s vanishes.
    return select((value.v0 == value.v1) & (value.v0 == value.v2), value.v0, mixed);
}
/// The same where all lanes are of one triangle.
template <Packet F>
F interpolate_of_one(const Barycentrics<F>& b, const PerVertex<float>& value) {
    const double v0 = value.v0;
    if (value.v0 == value.v1 && value.v0 == value.v2) return F(value.v0);
    return from_wide<F>(Wide<F>(v0) + b.b1 * Wide<F>(value.v1 - v0) +
                        b.b2 * Wide<F>(value.v2 - v0));
}
template <glm::length_t n, Number F>
glm::vec<n, F, glm::defaultp> interpolate(const Barycentrics<F>& b,
                                          const PerVertex<glm::vec<n, F, glm::defaultp>>& value) {
    glm::vec<n, F, glm::defaultp> result;
    for (glm::length_t i = 0; i < n; ++i)
        result[i] = interpolate(b, PerVertex<F>{value.v0[i], value.v1[i], value.v2[i]});
    return result;
}

/// Clip w at the lane: the perspective-correct w, (e_0 + e_1 + e_2) / sum(e_i / w_i).
template <Number F>
F interpolate_w(const EdgeValues<F>& e, const PerVertex<F>& w) {
    const Wide<F> product = to_wide(w.v0) * to_wide(w.v1) * to_wide(w.v2);
    return from_wide<F>(sum(e) * product / sum(perspective_edges(e, w)));
}

/// Which vertex of the original primitive gives flat values.
enum class ProvokingVertex : std::int32_t { first = 0, last = 2 };

/// A flat value: the provoking vertex's own bits.
template <class T>
T flat(const PerVertex<T>& value, ProvokingVertex provoking = ProvokingVertex::first) {
    return provoking == ProvokingVertex::first ? value.v0 : value.v2;
}

}  // namespace quadrel
