// Memory access, conversions and quad swaps that name their number type: load<F>(pointer),
// gather<F>(base, index).
#pragma once

#include "quadrel/num/traits.hpp"

namespace quadrel {

/// `lanes_of<F>` consecutive elements, from floats or from F's own scalar type.
template <class F, class Element>
F load(const Element* from) {
    return PacketOps<F>::load(from);
}
template <class F>
Int<F> load_int(const std::int32_t* from) {
    return PacketOps<F>::load_int(from);
}
/// True where the element is not 0.
template <class F>
Mask<F> load_mask(const std::uint32_t* from) {
    return PacketOps<F>::load_mask(from);
}
/// Integers to F, rounded to nearest even.
template <class F>
F to_float(Int<F> a) {
    return PacketOps<F>::from_int(a);
}
/// base[index] in every lane. Every index must be readable, in inactive lanes too.
template <class F>
F gather(const float* base, Int<F> index) {
    return PacketOps<F>::gather(base, index);
}
template <class F>
Int<F> gather_int(const std::int32_t* base, Int<F> index) {
    return PacketOps<F>::gather(base, index);
}
/// table[index] in every lane, of a table of 16; index in [0, 15].
template <class F>
Int<F> look_up16(const std::int32_t* table, Int<F> index) {
    return PacketOps<F>::look_up16(table, index);
}
/// base[index] and base[index + 1] of every lane, as two values.
template <class F>
void gather2(const float* base, Int<F> index, F out[2]) {
    PacketOps<F>::gather2(base, index, out);
}
/// base[index] to base[index + 3] of every lane, as four values.
template <class F>
void gather4(const float* base, Int<F> index, F out[4]) {
    PacketOps<F>::gather4(base, index, out);
}

/// At the end of a function on F that plain code calls.
template <class F>
void leave() {
    if constexpr (requires { PacketOps<F>::leave(); }) PacketOps<F>::leave();
}

/// F's lanes as doubles, exactly; consecutive doubles; doubles rounded to F.
template <class F>
Wide<F> to_wide(F a) {
    return WideOps<F>::widen(a);
}
template <class F>
Wide<F> load_wide(const double* from) {
    return WideOps<F>::load(from);
}
template <class F>
F from_wide(Wide<F> a) {
    return WideOps<F>::narrow(a);
}

/// The value of the neighbour in x, in y, and across the diagonal of the quad.
template <class F>
F swap_horizontal(F v) {
    return PacketOps<F>::template swizzle<1, 0, 3, 2>(v);
}
template <class F>
F swap_vertical(F v) {
    return PacketOps<F>::template swizzle<2, 3, 0, 1>(v);
}
template <class F>
F swap_diagonal(F v) {
    return PacketOps<F>::template swizzle<3, 2, 1, 0>(v);
}
/// Lane k (0 to 3) of each quad in all four of its lanes.
template <int k, class F>
F broadcast_lane(F v) {
    return PacketOps<F>::template swizzle<k, k, k, k>(v);
}

/// True in lanes 1 and 3 (odd x) of every quad; in lanes 2 and 3 (odd y).
template <class F>
Mask<F> lane_is_right() {
    alignas(64) static constexpr std::uint32_t pattern[16] = {0, 1, 0, 1, 0, 1, 0, 1,
                                                              0, 1, 0, 1, 0, 1, 0, 1};
    return load_mask<F>(pattern);
}
template <class F>
Mask<F> lane_is_below() {
    alignas(64) static constexpr std::uint32_t pattern[16] = {0, 0, 1, 1, 0, 0, 1, 1,
                                                              0, 0, 1, 1, 0, 0, 1, 1};
    return load_mask<F>(pattern);
}

}  // namespace quadrel
