// Window-space finite differences over a quad, as a GPU takes them.
// Fine: each row (column) its own difference. Coarse: the top row's (left column's) for all four.
// Source: Vulkan specification, "Derivative Operations"; lanes 0 1 / 2 3.
#pragma once

#include "quadrel/num/functions.hpp"

namespace quadrel {

/// Which of the two legal differences dFdx and dFdy take.
enum class DerivativeMode : std::int32_t { fine = 0, coarse = 1 };

/// Right minus left, in each row.
template <Packet F>
F dFdx_fine(F v) {
    const F other = swap_horizontal(v);
    return select(lane_is_right<F>(), v - other, other - v);
}
/// Larger window y minus smaller, in each column.
template <Packet F>
F dFdy_fine(F v) {
    const F other = swap_vertical(v);
    return select(lane_is_below<F>(), v - other, other - v);
}
template <Packet F>
F dFdx_coarse(F v) {
    return broadcast_lane<1>(v) - broadcast_lane<0>(v);
}
template <Packet F>
F dFdy_coarse(F v) {
    return broadcast_lane<2>(v) - broadcast_lane<0>(v);
}
template <Packet F>
F dFdx(F v, DerivativeMode mode = DerivativeMode::fine) {
    return mode == DerivativeMode::fine ? dFdx_fine(v) : dFdx_coarse(v);
}
template <Packet F>
F dFdy(F v, DerivativeMode mode = DerivativeMode::fine) {
    return mode == DerivativeMode::fine ? dFdy_fine(v) : dFdy_coarse(v);
}
/// |dFdx| + |dFdy|.
template <Packet F>
F fwidth(F v, DerivativeMode mode = DerivativeMode::fine) {
    return abs(dFdx(v, mode)) + abs(dFdy(v, mode));
}

template <int size, Packet F>
vec<size, F> dFdx(const vec<size, F>& v, DerivativeMode mode = DerivativeMode::fine) {
    return map_components([mode](F x) { return dFdx(x, mode); }, v);
}
template <int size, Packet F>
vec<size, F> dFdy(const vec<size, F>& v, DerivativeMode mode = DerivativeMode::fine) {
    return map_components([mode](F x) { return dFdy(x, mode); }, v);
}
template <int size, Packet F>
vec<size, F> fwidth(const vec<size, F>& v, DerivativeMode mode = DerivativeMode::fine) {
    return map_components([mode](F x) { return fwidth(x, mode); }, v);
}

}  // namespace quadrel
