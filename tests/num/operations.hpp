// Every function and operator of the room as a table of rows over plain arrays: what is compared
// between number types and across instruction-set modules. Compiled into the tests for
// Quad<float>, Quad<double>, float and double, and into each module for Lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "quadrel/num/derivative.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/num/srgb.hpp"

namespace quadrel::num_tests {

/// The most values that a row gives per lane.
inline constexpr std::size_t max_outputs = 9;

/// Evaluates one operation on `count` triples (a multiple of 16). Value k of element i goes to
/// out[k * count + i] as bits, all NaNs as one; out has max_outputs * count elements.
template <class T>
struct Operation {
    const char* name;
    void (*run)(const T* a, const T* b, const T* c, std::size_t count, std::uint64_t* out);
};

/// What a module exports.
struct OperationTable {
    const Operation<float>* rows;
    std::size_t size;
    int lanes;
};

template <class T>
std::uint64_t canonical_bits(T x) {
    if (x != x) return sizeof(T) == 4 ? 0x7fc00000u : 0x7ff8000000000000u;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof x);
    return bits;
}

template <Number F>
struct Emit {
    static constexpr int lanes = lanes_of<F>;

    static void value(F v, std::uint64_t* out, std::size_t) {
        Scalar<F> lane[lanes];
        store(lane, v);
        for (int i = 0; i < lanes; ++i) out[i] = canonical_bits(lane[i]);
    }
    static void value(Int<F> v, std::uint64_t* out, std::size_t) {
        std::int32_t lane[lanes];
        store(lane, v);
        for (int i = 0; i < lanes; ++i) out[i] = static_cast<std::uint32_t>(lane[i]);
    }
    static void value(Mask<F> v, std::uint64_t* out, std::size_t) {
        std::uint32_t lane[lanes];
        store(lane, v);
        for (int i = 0; i < lanes; ++i) out[i] = lane[i];
    }
    template <int size>
    static void value(const vec<size, F>& v, std::uint64_t* out, std::size_t count) {
        for (int k = 0; k < size; ++k) value(v[k], out + k * count, count);
    }
    static void value(const mat3<F>& m, std::uint64_t* out, std::size_t count) {
        for (int k = 0; k < 9; ++k) value(m[k / 3][k % 3], out + k * count, count);
    }
};

template <Number F, class Op>
void run_operation(const Scalar<F>* a, const Scalar<F>* b, const Scalar<F>* c, std::size_t count,
                   std::uint64_t* out) {
    for (std::size_t i = 0; i < count; i += lanes_of<F>) {
        Emit<F>::value(Op{}(load<F>(a + i), load<F>(b + i), load<F>(c + i)), out + i, count);
    }
}
template <Number F, class Op>
constexpr Operation<Scalar<F>> row(const char* name, Op) {
    return {name, &run_operation<F, Op>};
}

/// Rows for every number type.
template <Number F>
inline const auto common_rows = std::to_array<Operation<Scalar<F>>>({
    row<F>("a+b", [](F a, F b, F) { return a + b; }),
    row<F>("a-b", [](F a, F b, F) { return a - b; }),
    row<F>("a*b", [](F a, F b, F) { return a * b; }),
    row<F>("a/b", [](F a, F b, F) { return a / b; }),
    row<F>("-a", [](F a, F, F) { return -a; }),
    row<F>("+a", [](F a, F, F) { return +a; }),
    row<F>("a+=b", [](F a, F b, F) { return a += b; }),
    row<F>("a-=b", [](F a, F b, F) { return a -= b; }),
    row<F>("a*=b", [](F a, F b, F) { return a *= b; }),
    row<F>("a/=b", [](F a, F b, F) { return a /= b; }),
    row<F>("a<b", [](F a, F b, F) { return Mask<F>(a < b); }),
    row<F>("a<=b", [](F a, F b, F) { return Mask<F>(a <= b); }),
    row<F>("a>b", [](F a, F b, F) { return Mask<F>(a > b); }),
    row<F>("a>=b", [](F a, F b, F) { return Mask<F>(a >= b); }),
    row<F>("a==b", [](F a, F b, F) { return Mask<F>(a == b); }),
    row<F>("a!=b", [](F a, F b, F) { return Mask<F>(a != b); }),
    row<F>("mask&", [](F a, F b, F c) { return Mask<F>((a < b) & (b < c)); }),
    row<F>("mask|", [](F a, F b, F c) { return Mask<F>((a < b) | (b < c)); }),
    row<F>("mask!", [](F a, F b, F) { return Mask<F>(!(a < b)); }),
    row<F>("select", [](F a, F b, F c) { return select(a < b, c, a); }),
    row<F>("sqrt", [](F a, F, F) { return sqrt(a); }),
    row<F>("abs", [](F a, F, F) { return abs(a); }),
    row<F>("floor", [](F a, F, F) { return floor(a); }),
    row<F>("ceil", [](F a, F, F) { return ceil(a); }),
    row<F>("trunc", [](F a, F, F) { return trunc(a); }),
    row<F>("round_even", [](F a, F, F) { return round_even(a); }),
    row<F>("copysign", [](F a, F b, F) { return copysign(a, b); }),
    row<F>("to_int", [](F a, F, F) { return to_int(a); }),
    row<F>("to_int_in_range",
           [](F a, F, F) { return to_int_in_range(select(abs(a) < F(1e9f), a, F(-7.5f))); }),
    row<F>("to_float", [](F a, F, F) { return to_float<F>(to_int(a)); }),
    row<F>("wide a*b+c",
           [](F a, F b, F c) { return from_wide<F>(to_wide(a) * to_wide(b) + to_wide(c)); }),
    row<F>("wide a/b-c",
           [](F a, F b, F c) { return from_wide<F>(to_wide(a) / to_wide(b) - to_wide(c)); }),
    row<F>("exponent", [](F a, F, F) { return exponent(a); }),
    row<F>("significand", [](F a, F, F) { return significand(a); }),
    row<F>("power_of_two",
           [](F a, F, F) { return power_of_two(clamp(floor(a), F(-126), F(127))); }),
    row<F>("min", [](F a, F b, F) { return min(a, b); }),
    row<F>("max", [](F a, F b, F) { return max(a, b); }),
    row<F>("clamp", [](F a, F b, F c) { return clamp(a, b, c); }),
    row<F>("saturate", [](F a, F, F) { return saturate(a); }),
    row<F>("is_nan", [](F a, F, F) { return Mask<F>(is_nan(a)); }),
    row<F>("is_finite", [](F a, F, F) { return Mask<F>(is_finite(a)); }),
    row<F>("sign", [](F a, F, F) { return sign(a); }),
    row<F>("fract", [](F a, F, F) { return fract(a); }),
    row<F>("mod", [](F a, F b, F) { return mod(a, b); }),
    row<F>("mix", [](F a, F b, F c) { return mix(a, b, c); }),
    row<F>("lerp", [](F a, F b, F c) { return lerp(a, b, c); }),
    row<F>("step", [](F a, F b, F) { return step(a, b); }),
    row<F>("smoothstep", [](F a, F b, F c) { return smoothstep(a, b, c); }),
    row<F>("inversesqrt", [](F a, F, F) { return inversesqrt(a); }),
    row<F>("dot2", [](F a, F b, F c) { return dot(vec2<F>(a, b), vec2<F>(c, a)); }),
    row<F>("dot3", [](F a, F b, F c) { return dot(vec3<F>(a, b, c), vec3<F>(b, c, a)); }),
    row<F>("dot4", [](F a, F b, F c) { return dot(vec4<F>(a, b, c, a), vec4<F>(b, c, a, c)); }),
    row<F>("cross", [](F a, F b, F c) { return cross(vec3<F>(a, b, c), vec3<F>(b, c, b)); }),
    row<F>("length", [](F a, F b, F c) { return length(vec3<F>(a, b, c)); }),
    row<F>("distance", [](F a, F b, F c) { return distance(vec2<F>(a, b), vec2<F>(b, c)); }),
    row<F>("normalize2", [](F a, F b, F) { return normalize(vec2<F>(a, b)); }),
    row<F>("normalize3", [](F a, F b, F c) { return normalize(vec3<F>(a, b, c)); }),
    row<F>("reflect", [](F a, F b, F c) { return reflect(vec3<F>(a, b, c), vec3<F>(c, a, b)); }),
    row<F>("refract", [](F a, F b, F c) { return refract(vec3<F>(a, b, c), vec3<F>(c, a, b), b); }),
    row<F>("faceforward",
           [](F a, F b, F c) {
               return faceforward(vec3<F>(a, b, c), vec3<F>(c, a, b), vec3<F>(b, b, c));
           }),
    row<F>("vec min", [](F a, F b, F c) { return min(vec3<F>(a, b, c), vec3<F>(c, a, b)); }),
    row<F>("vec max", [](F a, F b, F c) { return max(vec3<F>(a, b, c), vec3<F>(c, a, b)); }),
    row<F>("vec clamp", [](F a, F b, F c) { return clamp(vec3<F>(a, b, c), b, c); }),
    row<F>("vec mod", [](F a, F b, F c) { return mod(vec2<F>(a, b), c); }),
    row<F>("vec mix", [](F a, F b, F c) { return mix(vec2<F>(a, b), vec2<F>(b, c), c); }),
    row<F>("vec lerp", [](F a, F b, F c) { return lerp(vec2<F>(a, b), vec2<F>(b, c), c); }),
    row<F>("vec floor", [](F a, F b, F c) { return floor(vec3<F>(a, b, c)); }),
    row<F>("vec fract", [](F a, F b, F c) { return fract(vec3<F>(a, b, c)); }),
    row<F>("vec abs", [](F a, F b, F c) { return abs(vec3<F>(a, b, c)); }),
    row<F>("vec sign", [](F a, F b, F c) { return sign(vec3<F>(a, b, c)); }),
    row<F>("vec select", [](F a, F b, F c) { return select(a < b, vec2<F>(a, c), vec2<F>(c, b)); }),
    row<F>("vec*number", [](F a, F b, F c) { return vec3<F>(a, b, c) * a; }),
    row<F>("determinant",
           [](F a, F b, F c) { return determinant(mat3<F>(a, b, c, b, c, c, a, a, b)); }),
    row<F>("inverse", [](F a, F b, F c) { return inverse(mat3<F>(a, b, c, b, c, c, a, a, b)); }),
    row<F>("transpose",
           [](F a, F b, F c) { return transpose(mat3<F>(a, b, c, b, c, c, a, a, b)); }),
    row<F>("mat3*vec3",
           [](F a, F b, F c) { return mat3<F>(a, b, c, b, c, c, a, a, b) * vec3<F>(c, b, a); }),
    row<F>("exp2", [](F a, F, F) { return exp2(a); }),
    row<F>("exp", [](F a, F, F) { return exp(a); }),
    row<F>("log2", [](F a, F, F) { return log2(a); }),
    row<F>("log", [](F a, F, F) { return log(a); }),
    row<F>("pow", [](F a, F b, F) { return pow(a, b); }),
    row<F>("pow of magnitude", [](F a, F b, F) { return pow(abs(a), b); }),
    row<F>("sin", [](F a, F, F) { return sin(a); }),
    row<F>("cos", [](F a, F, F) { return cos(a); }),
    row<F>("tan", [](F a, F, F) { return tan(a); }),
    row<F>("atan2", [](F a, F b, F) { return atan2(a, b); }),
    row<F>("atan", [](F a, F, F) { return atan(a); }),
    row<F>("asin", [](F a, F, F) { return asin(a); }),
    row<F>("acos", [](F a, F, F) { return acos(a); }),
    row<F>("radians", [](F a, F, F) { return radians(a); }),
    row<F>("degrees", [](F a, F, F) { return degrees(a); }),
    row<F>("srgb_decode", [](F a, F, F) { return srgb_decode(a); }),
    row<F>("srgb_encode", [](F a, F, F) { return srgb_encode(a); }),
});

/// Some integer of a number: its bits where it is a float.
template <Packet F>
Int<F> integer_of(F a) {
    if constexpr (sizeof(Scalar<F>) == 4) {
        return as_int(a);
    } else {
        return to_int(a);
    }
}
template <Packet F>
F gathered(F a) {
    static constexpr float table[8] = {1.0f, -2.5f, 0x1p-149f, 3e38f, -0.0f, 7.0f, 1e-38f, 0.1f};
    return gather<F>(table, integer_of(a) & Int<F>(7));
}
template <Packet F>
Int<F> gathered_int(F a) {
    static constexpr std::int32_t table[4] = {0, -1, 0x7fffffff, 42};
    return gather_int<F>(table, integer_of(a) & Int<F>(3));
}

template <Packet F>
Int<F> looked_up(F a) {
    static constexpr std::int32_t table[16] = {5, 0,  -1, 0x7fffffff, 42, 9, 3,   -77,
                                               8, 16, 99, 1 << 30,    2,  7, -64, 1000};
    return look_up16<F>(table, integer_of(a) & Int<F>(15));
}

inline constexpr float texels[12] = {1.0f,   -2.5f, 0x1p-149f, 3e38f, -0.0f, 7.0f,
                                     1e-38f, 0.1f,  -3.0f,     0.2f,  5e8f,  -1e-40f};
template <Packet F>
vec2<F> gathered_pair(F a) {
    F out[2];
    gather2(texels, integer_of(a) & Int<F>(7), out);
    return {out[0], out[1]};
}
template <Packet F>
vec4<F> gathered_four(F a) {
    F out[4];
    gather4(texels, integer_of(a) & Int<F>(7), out);
    return {out[0], out[1], out[2], out[3]};
}

/// Packets differ in width: whether any() and all() agree with the packet's own lanes.
template <Packet F>
Mask<F> any_agrees(Mask<F> m) {
    std::uint32_t lane[lanes_of<F>];
    store(lane, m);
    std::uint32_t found = 0;
    for (const std::uint32_t l : lane) found |= l;
    return Mask<F>(any(m) == (found != 0));
}
template <Packet F>
Mask<F> all_agrees(Mask<F> m) {
    std::uint32_t lane[lanes_of<F>];
    store(lane, m);
    std::uint32_t found = 0xffffffffu;
    for (const std::uint32_t l : lane) found &= l;
    return Mask<F>(all(m) == (found != 0));
}

/// Rows for packets: neighbours, derivatives, integers, memory, calls that mix plain numbers.
template <Packet F>
inline const auto packet_rows = std::to_array<Operation<Scalar<F>>>({
    row<F>("swap_horizontal", [](F a, F, F) { return swap_horizontal(a); }),
    row<F>("swap_vertical", [](F a, F, F) { return swap_vertical(a); }),
    row<F>("swap_diagonal", [](F a, F, F) { return swap_diagonal(a); }),
    row<F>("broadcast_lane 0", [](F a, F, F) { return broadcast_lane<0>(a); }),
    row<F>("broadcast_lane 1", [](F a, F, F) { return broadcast_lane<1>(a); }),
    row<F>("broadcast_lane 2", [](F a, F, F) { return broadcast_lane<2>(a); }),
    row<F>("broadcast_lane 3", [](F a, F, F) { return broadcast_lane<3>(a); }),
    row<F>("lane_is_right", [](F, F, F) { return lane_is_right<F>(); }),
    row<F>("lane_is_below", [](F, F, F) { return lane_is_below<F>(); }),
    row<F>("dFdx_fine", [](F a, F, F) { return dFdx_fine(a); }),
    row<F>("dFdy_fine", [](F a, F, F) { return dFdy_fine(a); }),
    row<F>("dFdx_coarse", [](F a, F, F) { return dFdx(a, DerivativeMode::coarse); }),
    row<F>("dFdy_coarse", [](F a, F, F) { return dFdy(a, DerivativeMode::coarse); }),
    row<F>("fwidth", [](F a, F, F) { return fwidth(a); }),
    row<F>("vec dFdx", [](F a, F b, F c) { return dFdx(vec3<F>(a, b, c)); }),
    row<F>("vec dFdy", [](F a, F b, F c) { return dFdy(vec3<F>(a, b, c)); }),
    row<F>("any", [](F a, F b, F) { return any_agrees<F>(a < b); }),
    row<F>("all", [](F a, F b, F) { return all_agrees<F>(a < b); }),
    row<F>("int", [](F a, F, F) { return integer_of(a); }),
    row<F>("int a+b", [](F a, F b, F) { return integer_of(a) + integer_of(b); }),
    row<F>("int a-b", [](F a, F b, F) { return integer_of(a) - integer_of(b); }),
    row<F>("int a*b", [](F a, F b, F) { return integer_of(a) * integer_of(b); }),
    row<F>("int -a", [](F a, F, F) { return -integer_of(a); }),
    row<F>("int a&b", [](F a, F b, F) { return integer_of(a) & integer_of(b); }),
    row<F>("int a|b", [](F a, F b, F) { return integer_of(a) | integer_of(b); }),
    row<F>("int a^b", [](F a, F b, F) { return integer_of(a) ^ integer_of(b); }),
    row<F>("int shift_left", [](F a, F, F) { return shift_left<5>(integer_of(a)); }),
    row<F>("int shift_right", [](F a, F, F) { return shift_right<7>(integer_of(a)); }),
    row<F>("int shift_left by lanes",
           [](F a, F b, F) { return shift_left(integer_of(a), integer_of(b) & Int<F>(31)); }),
    row<F>("int shift_right by lanes",
           [](F a, F b, F) { return shift_right(integer_of(a), integer_of(b) & Int<F>(31)); }),
    row<F>("int a==b", [](F a, F b, F) { return integer_of(a) == integer_of(b); }),
    row<F>("int a!=b", [](F a, F b, F) { return integer_of(a) != integer_of(b); }),
    row<F>("int a<b", [](F a, F b, F) { return integer_of(a) < integer_of(b); }),
    row<F>("int a<=b", [](F a, F b, F) { return integer_of(a) <= integer_of(b); }),
    row<F>("int a>b", [](F a, F b, F) { return integer_of(a) > integer_of(b); }),
    row<F>("int a>=b", [](F a, F b, F) { return integer_of(a) >= integer_of(b); }),
    row<F>("int select", [](F a, F b, F c) { return select(a < b, integer_of(a), integer_of(c)); }),
    row<F>("int min", [](F a, F b, F) { return min(integer_of(a), integer_of(b)); }),
    row<F>("int max", [](F a, F b, F) { return max(integer_of(a), integer_of(b)); }),
    row<F>("to_float of int", [](F a, F, F) { return to_float<F>(integer_of(a)); }),
    row<F>("gather", [](F a, F, F) { return gathered(a); }),
    row<F>("gather_int", [](F a, F, F) { return gathered_int(a); }),
    row<F>("look_up16", [](F a, F, F) { return looked_up(a); }),
    row<F>("gather2", [](F a, F, F) { return gathered_pair(a); }),
    row<F>("gather4", [](F a, F, F) { return gathered_four(a); }),
    row<F>("mixed max", [](F a, F, F) { return max(a, 0.25f); }),
    row<F>("mixed mix", [](F a, F b, F) { return mix(a, b, 0.25f); }),
    row<F>("mixed clamp", [](F a, F, F) { return clamp(a, -0.5f, 0.5f); }),
    row<F>("mixed vec", [](F a, F b, F) { return 0.5f - vec2<F>(a, b) * 2.0f / 3.0f; }),
});

}  // namespace quadrel::num_tests
