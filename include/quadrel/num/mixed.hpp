// Calls that mix packets with plain numbers, as shaders do: max(x, 0.0f), mix(0.2f, x, t). The
// plain arguments are rounded to the packet's scalar type and put into every lane. Two different
// packet types never mix, and neither do float and double alone.
#pragma once

#include <concepts>
#include <type_traits>

#include "quadrel/num/geometric.hpp"

namespace quadrel {

/// int, float, double and the like.
template <class S>
concept PlainNumber = std::is_arithmetic_v<S>;

namespace detail {
/// The first packet type among the arguments; void when there is none.
template <class... Args>
struct PacketAmong {
    using type = void;
};
template <class First, class... Rest>
struct PacketAmong<First, Rest...> {
    using type = typename PacketAmong<Rest...>::type;
};
template <Packet First, class... Rest>
struct PacketAmong<First, Rest...> {
    using type = First;
};
template <class F, class Arg>
concept SameOrPlain = std::same_as<F, Arg> || PlainNumber<Arg>;
}  // namespace detail

template <class... Args>
using PacketAmong = typename detail::PacketAmong<Args...>::type;

/// At least one packet and at least one plain number.
template <class... Args>
concept MixedNumbers = Packet<PacketAmong<Args...>> &&
                       (detail::SameOrPlain<PacketAmong<Args...>, Args>&&...) &&
                       (PlainNumber<Args> || ...);

/// A plain number in every lane of F; F itself unchanged.
template <Packet F, class Arg>
F widen(Arg a) {
    if constexpr (std::same_as<F, Arg>) {
        return a;
    } else {
        return F(static_cast<Scalar<F>>(a));
    }
}

template <class A, class B>
requires MixedNumbers<A, B>
auto min(A a, B b) {
    using F = PacketAmong<A, B>;
    return min(widen<F>(a), widen<F>(b));
}
template <class A, class B>
requires MixedNumbers<A, B>
auto max(A a, B b) {
    using F = PacketAmong<A, B>;
    return max(widen<F>(a), widen<F>(b));
}
template <class A, class B>
requires MixedNumbers<A, B>
auto mod(A x, B y) {
    using F = PacketAmong<A, B>;
    return mod(widen<F>(x), widen<F>(y));
}
template <class A, class B>
requires MixedNumbers<A, B>
auto step(A edge, B x) {
    using F = PacketAmong<A, B>;
    return step(widen<F>(edge), widen<F>(x));
}
template <class A, class B, class C>
requires MixedNumbers<A, B, C>
auto clamp(A x, B low, C high) {
    using F = PacketAmong<A, B, C>;
    return clamp(widen<F>(x), widen<F>(low), widen<F>(high));
}
template <class A, class B, class C>
requires MixedNumbers<A, B, C>
auto mix(A a, B b, C t) {
    using F = PacketAmong<A, B, C>;
    return mix(widen<F>(a), widen<F>(b), widen<F>(t));
}
template <class A, class B, class C>
requires MixedNumbers<A, B, C>
auto lerp(A a, B b, C t) {
    using F = PacketAmong<A, B, C>;
    return lerp(widen<F>(a), widen<F>(b), widen<F>(t));
}
template <class A, class B, class C>
requires MixedNumbers<A, B, C>
auto smoothstep(A edge0, B edge1, C x) {
    using F = PacketAmong<A, B, C>;
    return smoothstep(widen<F>(edge0), widen<F>(edge1), widen<F>(x));
}
template <class A, class B>
requires MixedNumbers<A, B>
auto select(Mask<PacketAmong<A, B>> m, A a, B b) {
    using F = PacketAmong<A, B>;
    return select(m, widen<F>(a), widen<F>(b));
}

// ---- Vectors of packets with plain numbers ------------------------------------------------------

template <int size, Packet F, PlainNumber S>
vec<size, F> min(const vec<size, F>& a, S b) {
    return min(a, widen<F>(b));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> max(const vec<size, F>& a, S b) {
    return max(a, widen<F>(b));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> mod(const vec<size, F>& v, S y) {
    return mod(v, widen<F>(y));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> clamp(const vec<size, F>& v, S low, S high) {
    return clamp(v, widen<F>(low), widen<F>(high));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> mix(const vec<size, F>& a, const vec<size, F>& b, S t) {
    return mix(a, b, widen<F>(t));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> lerp(const vec<size, F>& a, const vec<size, F>& b, S t) {
    return lerp(a, b, widen<F>(t));
}
template <int size, Packet F, PlainNumber S>
vec<size, F> refract(const vec<size, F>& i, const vec<size, F>& n, S eta) {
    return refract(i, n, widen<F>(eta));
}

}  // namespace quadrel
