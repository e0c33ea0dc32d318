// The functions of num/ on Shader: a shading language's own, where it has them with the meaning of
// num/functions.hpp; what is made of others comes out as what it is made of.
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/num/shader/shader.hpp"

namespace quadrel {

inline Shader select(const ShaderMask& m, const Shader& a, const Shader& b) {
    return Shader(recorded::choose(m.node(), a.node(), b.node()));
}
inline ShaderInt select(const ShaderMask& m, const ShaderInt& a, const ShaderInt& b) {
    return ShaderInt(recorded::choose(m.node(), a.node(), b.node()));
}
inline ShaderMask select(const ShaderMask& m, const ShaderMask& a, const ShaderMask& b) {
    return ShaderMask(recorded::choose(m.node(), a.node(), b.node()));
}

namespace recorded {
inline Shader real(const char* function, std::vector<Node*> arguments) {
    return Shader(call(Type::real, function, std::move(arguments)));
}
inline ShaderInt integer(const char* function, std::vector<Node*> arguments) {
    return ShaderInt(call(Type::integer, function, std::move(arguments)));
}
}  // namespace recorded

inline Shader sqrt(const Shader& a) { return recorded::real("sqrt", {a.node()}); }
inline Shader abs(const Shader& a) { return recorded::real("abs", {a.node()}); }
inline Shader floor(const Shader& a) { return recorded::real("floor", {a.node()}); }
inline Shader ceil(const Shader& a) { return recorded::real("ceil", {a.node()}); }
inline Shader trunc(const Shader& a) { return recorded::real("trunc", {a.node()}); }
inline Shader round_even(const Shader& a) { return recorded::real("roundEven", {a.node()}); }
inline Shader fract(Shader a) { return recorded::real("fract", {a.node()}); }
inline Shader sign(Shader a) { return recorded::real("sign", {a.node()}); }
inline Shader inversesqrt(Shader a) { return recorded::real("inversesqrt", {a.node()}); }
inline Shader exp2(Shader a) { return recorded::real("exp2", {a.node()}); }
inline Shader exp(Shader a) { return recorded::real("exp", {a.node()}); }
inline Shader log2(Shader a) { return recorded::real("log2", {a.node()}); }
inline Shader log(Shader a) { return recorded::real("log", {a.node()}); }
inline Shader sin(Shader a) { return recorded::real("sin", {a.node()}); }
inline Shader cos(Shader a) { return recorded::real("cos", {a.node()}); }
inline Shader tan(Shader a) { return recorded::real("tan", {a.node()}); }
inline Shader asin(Shader a) { return recorded::real("asin", {a.node()}); }
inline Shader acos(Shader a) { return recorded::real("acos", {a.node()}); }
inline Shader atan(Shader a) { return recorded::real("atan", {a.node()}); }
inline Shader atan2(Shader y, Shader x) { return recorded::real("atan", {y.node(), x.node()}); }
inline Shader pow(Shader a, Shader b) { return recorded::real("pow", {a.node(), b.node()}); }
inline Shader mod(Shader a, Shader b) { return recorded::real("mod", {a.node(), b.node()}); }
inline Shader min(Shader a, Shader b) { return recorded::real("min", {a.node(), b.node()}); }
inline Shader max(Shader a, Shader b) { return recorded::real("max", {a.node(), b.node()}); }
inline Shader step(Shader edge, Shader x) {
    return recorded::real("step", {edge.node(), x.node()});
}
inline Shader clamp(Shader x, Shader low, Shader high) {
    return recorded::real("clamp", {x.node(), low.node(), high.node()});
}
inline Shader mix(Shader a, Shader b, Shader t) {
    return recorded::real("mix", {a.node(), b.node(), t.node()});
}
inline ShaderMask is_nan(Shader x) {
    return ShaderMask(recorded::call(recorded::Type::boolean, "isnan", {x.node()}));
}
inline ShaderInt to_int(const Shader& x) { return recorded::integer("int", {x.node()}); }
inline ShaderInt to_int_in_range(const Shader& x) { return to_int(x); }
inline ShaderInt min(const ShaderInt& a, const ShaderInt& b) {
    return recorded::integer("min", {a.node(), b.node()});
}
inline ShaderInt max(const ShaderInt& a, const ShaderInt& b) {
    return recorded::integer("max", {a.node(), b.node()});
}

// Of the bits of a number: functions that a shader brings with it, under these names.
inline ShaderInt as_int(const Shader& x) { return recorded::integer("floatBitsToInt", {x.node()}); }
inline Shader as_float(const ShaderInt& x) { return recorded::real("intBitsToFloat", {x.node()}); }
inline Shader exponent(const Shader& x) { return recorded::real("exponent", {x.node()}); }
inline Shader significand(const Shader& x) { return recorded::real("significand", {x.node()}); }
inline Shader power_of_two(const Shader& n) { return recorded::real("power_of_two", {n.node()}); }
inline Shader copysign(const Shader& a, const Shader& b) {
    return recorded::real("copysign", {a.node(), b.node()});
}

/// Which of the two legal differences is taken, an implementation chooses.
inline Shader dFdx(Shader a, DerivativeMode = DerivativeMode::fine) {
    return recorded::real("dFdx", {a.node()});
}
inline Shader dFdy(Shader a, DerivativeMode = DerivativeMode::fine) {
    return recorded::real("dFdy", {a.node()});
}

// ---- Vectors ------------------------------------------------------------------------------------

namespace recorded {
template <int n>
Node* pack(const vec<n, Shader>& v) {
    std::vector<Node*> components;
    for (int i = 0; i < n; ++i) components.push_back(v[i].node());
    return make(Node::Kind::construct, vector_of(n), "", std::move(components));
}
template <int n>
vec<n, Shader> unpack(Node* v) {
    vec<n, Shader> result;
    for (int i = 0; i < n; ++i) result[i] = Shader(component(v, i));
    return result;
}
template <int n>
vec<n, Shader> vector(const char* function, std::vector<Node*> arguments) {
    return unpack<n>(call(vector_of(n), function, std::move(arguments)));
}
}  // namespace recorded

inline Shader dot(const vec2<Shader>& a, const vec2<Shader>& b) {
    return recorded::real("dot", {recorded::pack<2>(a), recorded::pack<2>(b)});
}
inline Shader dot(const vec3<Shader>& a, const vec3<Shader>& b) {
    return recorded::real("dot", {recorded::pack<3>(a), recorded::pack<3>(b)});
}
inline Shader dot(const vec4<Shader>& a, const vec4<Shader>& b) {
    return recorded::real("dot", {recorded::pack<4>(a), recorded::pack<4>(b)});
}
inline vec3<Shader> cross(const vec3<Shader>& a, const vec3<Shader>& b) {
    return recorded::vector<3>("cross", {recorded::pack<3>(a), recorded::pack<3>(b)});
}
template <int n, Number F>
requires std::same_as<F, Shader> F length(const vec<n, F>& v) {
    return recorded::real("length", {recorded::pack<n>(v)});
}
template <int n, Number F>
requires std::same_as<F, Shader> F distance(const vec<n, F>& a, const vec<n, F>& b) {
    return recorded::real("distance", {recorded::pack<n>(a), recorded::pack<n>(b)});
}
template <int n, Number F>
requires std::same_as<F, Shader> vec<n, F> normalize(const vec<n, F>& v) {
    return recorded::vector<n>("normalize", {recorded::pack<n>(v)});
}
template <int n, Number F>
requires std::same_as<F, Shader> vec<n, F> reflect(const vec<n, F>& i, const vec<n, F>& normal) {
    return recorded::vector<n>("reflect", {recorded::pack<n>(i), recorded::pack<n>(normal)});
}
template <int n, Number F>
requires std::same_as<F, Shader> vec<n, F> refract(const vec<n, F>& i, const vec<n, F>& normal,
                                                   F eta) {
    return recorded::vector<n>("refract",
                               {recorded::pack<n>(i), recorded::pack<n>(normal), eta.node()});
}

}  // namespace quadrel
