// The normal of a displaced surface, shared by the stages that make it from heights.
//
//     n = normalize(N - D (h_u grad u + h_v grad v))
//
// is the normal of P(u, v) + D h(u, v) N, the curvature of the base left aside: exact where N is
// the face's normal, and where J N = 0 for any N.
#pragma once

#include "quadrel/relief/heights.hpp"

namespace quadrel {

/// What a normal from heights loads.
inline constexpr auto relief_normal_inputs =
    values(Value::relief_depth, Value::frame_normal, Value::J, Value::frame_status, Value::dUVdx,
           Value::dUVdy, Value::hit_uv);

/// The normal of texels around the hit.
struct NormalFromTexels : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = relief_normal_inputs;
    static constexpr bool needs_height_map = true;
};

/// The normal of slopes (dh/du, dh/dv) at relief depth `depth`, by the frame's normal and J.
template <class Io, class F = typename Io::Number>
vec3<F> relief_normal(const Io& io, const vec2<F>& slope, F depth) {
    const auto J = io.template load<Value::J>();
    const vec3<F> N = io.template load<Value::frame_normal>();
    return normalize(N - (J[0] * slope.x + J[1] * slope.y) * depth);
}

/// Stores n where there is a frame and `tilts`; the frame's normal elsewhere.
template <class Io, class F = typename Io::Number>
void store_normal(const Io& io, const vec3<F>& n, Mask<F> tilts) {
    const vec3<F> N = io.template load<Value::frame_normal>();
    const Mask<F> framed = io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
    io.template store<Value::N>(select(framed & tilts, n, N));
}

/// Stores the normal of `slope()`, which is not asked for where no lane has depth. Depth 0 gives
/// the frame's normal, bit for bit.
template <class Io, class Slope>
void store_relief_normal(const Io& io, const Slope& slope) {
    using F = typename Io::Number;
    const F depth = io.template load<Value::relief_depth>();
    const Mask<F> deep = depth != F(0);
    vec3<F> n(F(0));
    if (when(deep)) n = select(deep, relief_normal<Io, F>(io, slope(), depth), n);
    store_normal(io, n, deep);
}

}  // namespace quadrel
