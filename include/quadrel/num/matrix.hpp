// GLSL's matrix functions (GLSL 4.60 specification, 8.6) for 2x2 and 3x3, column-major:
// m[column][row]. Products are GLM's operators.
#pragma once

#include "quadrel/num/geometric.hpp"

namespace quadrel {

template <Number F>
mat2<F> transpose(const mat2<F>& m) {
    return {m[0][0], m[1][0], m[0][1], m[1][1]};
}
template <Number F>
mat3<F> transpose(const mat3<F>& m) {
    return {m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]};
}
/// The matrix a b^T: column j is a * b[j].
template <Number F>
mat3<F> outerProduct(const vec3<F>& a, const vec3<F>& b) {
    return {a * b.x, a * b.y, a * b.z};
}

/// m00 m11 - m10 m01, indices [column][row].
template <Number F>
F determinant(const mat2<F>& m) {
    return m[0][0] * m[1][1] - m[1][0] * m[0][1];
}
/// dot(m[0], cross(m[1], m[2])).
template <Number F>
F determinant(const mat3<F>& m) {
    return dot(m[0], cross(m[1], m[2]));
}

/// Cofactors over the determinant, each divided; a singular matrix gives infinities or NaN.
template <Number F>
mat2<F> inverse(const mat2<F>& m) {
    const F d = determinant(m);
    return {m[1][1] / d, -m[0][1] / d, -m[1][0] / d, m[0][0] / d};
}
/// Cofactors over the determinant, each divided; a singular matrix gives infinities or NaN. The
/// rows of the inverse are cross(m[1], m[2]), cross(m[2], m[0]) and cross(m[0], m[1]).
template <Number F>
mat3<F> inverse(const mat3<F>& m) {
    const vec3<F> first = cross(m[1], m[2]);
    const F d = dot(m[0], first);
    return transpose(mat3<F>(first / d, cross(m[2], m[0]) / d, cross(m[0], m[1]) / d));
}

}  // namespace quadrel
