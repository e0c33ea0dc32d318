// Vectors and matrices over any number type: GLM's types, constructors and operators. GLM's
// functions branch on values or add in a compiler-dependent order; use those of functions.hpp.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "quadrel/num/traits.hpp"

namespace quadrel {

template <int size, class F>
using vec = glm::vec<size, F, glm::defaultp>;
template <class F>
using vec2 = vec<2, F>;
template <class F>
using vec3 = vec<3, F>;
template <class F>
using vec4 = vec<4, F>;

/// Column-major, as in GLSL: m[column][row].
template <class F>
using mat2 = glm::mat<2, 2, F, glm::defaultp>;
template <class F>
using mat3 = glm::mat<3, 3, F, glm::defaultp>;
template <class F>
using mat4 = glm::mat<4, 4, F, glm::defaultp>;

// Plain numbers beside vectors of packets, as in GLSL: n * 0.5f + 0.5f. (GLM has the operators for
// equal component types.)

template <int size, Packet F>
vec<size, F> operator+(const vec<size, F>& v, Scalar<F> s) {
    return v + F(s);
}
template <int size, Packet F>
vec<size, F> operator-(const vec<size, F>& v, Scalar<F> s) {
    return v - F(s);
}
template <int size, Packet F>
vec<size, F> operator*(const vec<size, F>& v, Scalar<F> s) {
    return v * F(s);
}
template <int size, Packet F>
vec<size, F> operator/(const vec<size, F>& v, Scalar<F> s) {
    return v / F(s);
}
template <int size, Packet F>
vec<size, F> operator+(Scalar<F> s, const vec<size, F>& v) {
    return F(s) + v;
}
template <int size, Packet F>
vec<size, F> operator-(Scalar<F> s, const vec<size, F>& v) {
    return F(s) - v;
}
template <int size, Packet F>
vec<size, F> operator*(Scalar<F> s, const vec<size, F>& v) {
    return F(s) * v;
}
template <int size, Packet F>
vec<size, F> operator/(Scalar<F> s, const vec<size, F>& v) {
    return F(s) / v;
}

}  // namespace quadrel
