// What a number type is. Every algorithm text is a template over a number type F. A packet of F has
// 4*k lanes, quad by quad: lane 4q is (even x, even y), +1 (odd, even), +2 (even, odd), +3 (odd,
// odd). Plain float and double are number types of one lane, without neighbours.
#pragma once

#include <cstdint>

namespace quadrel {

/// Companions of a number type F:
///   Scalar  the type of one lane (float or double), also the element type in memory;
///   Int     a packet of 32-bit signed integers with as many lanes;
///   Mask    a packet of booleans with as many lanes;
///   lanes   how many.
template <class F>
struct NumberTraits;

template <class F>
using Scalar = typename NumberTraits<F>::Scalar;
template <class F>
using Int = typename NumberTraits<F>::Int;
template <class F>
using Mask = typename NumberTraits<F>::Mask;
template <class F>
inline constexpr int lanes_of = NumberTraits<F>::lanes;

/// A type that algorithm texts may be instantiated on.
template <class F>
concept Number = requires {
    typename NumberTraits<F>::Scalar;
};

/// A number type whose lanes carry more than a value, window-space derivatives (dual.hpp): its
/// traits name an Element, what a lane is in memory.
template <class F>
concept Differentiated = requires {
    typename NumberTraits<F>::Element;
};

namespace detail {
template <class F>
struct ElementOf {
    using Type = Scalar<F>;
};
template <Differentiated F>
struct ElementOf<F> {
    using Type = typename NumberTraits<F>::Element;
};
}  // namespace detail
/// What a lane is in the arrays that values are kept in.
template <class F>
using MemoryElement = typename detail::ElementOf<F>::Type;

/// A number type whose lanes form whole quads: what neighbours and derivatives need.
template <class F>
concept Packet = Number<F> && lanes_of<F>
% 4 == 0;

/// What needs F named rather than deduced, specialised beside each number type; use the functions
/// of packet.hpp.
///   load(const float* | const Scalar*)   consecutive elements, converted to F
///   load_int, load_mask                  likewise; a mask element is true when not 0
///   from_int(Int)                        to F, rounded to nearest even
///   gather(base, Int index)              base[index] lane by lane, converted to F
///   look_up16(table, Int index)          table[index] of a table of 16
///   gather2, gather4(base, index, out)   base[index + c] for c = 0, 1 (, 2, 3) into out[c]
///   product_error(a, b, product)         optional: a * b - product, rounded once
///   bilinear4(base, index[4], x, y, out)  optional: four elements each at the taps of a bilinear
///                                        footprint, blended with the weights x and y
///   trilinear4                           optional: the same of two footprints, the second blended
///                                        over the first where its weight is above 0
///   leave()                              optional: at the end of a function that plain code calls
///   swizzle<a, b, c, d>(F)               lane k of every quad takes lane {a, b, c, d}[k] of its
///                                        quad; packets only
template <class F>
struct PacketOps;

/// As many doubles as F has lanes, beside each number type as well: for what has to come out within
/// a rounding of the exact value. `Type` has + - * / and is made from a double; use the functions
/// of packet.hpp.
///   widen(F), load(const double*)   to Type
///   narrow(Type)                    to F, rounded to nearest even
template <class F>
struct WideOps;
template <class F>
using Wide = typename WideOps<F>::Type;

}  // namespace quadrel
