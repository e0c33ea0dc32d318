// The (co-)tangent frame of Rabbid76's listings, and what they do with a normal made in it.
//
// Source: "Normal, Parallax and Relief mapping" (Rabbid76, graphics-snippets), main of the general
// listing. The columns T and B are gradients of u and v, not tangents, and are scaled to a common
// length, so that the size of a tile is lost; the third column is multiplied component by
// component (`tbnMat[2].xyz *= sign * N / scale`), so that it holds the squares of N's components
// with N's facing: right only along an axis.
#pragma once

#include "quadrel/relief/heights.hpp"

namespace quadrel {

/// A normal of that listing.
struct RabbidNormal : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = values(Value::P, Value::Ng, Value::vertex_normal, Value::dPdx,
                                          Value::dPdy, Value::dUVdx, Value::dUVdy, Value::hit_uv);
    static constexpr bool needs_height_map = true;
};

/// normalize( tbnMat * n ) after the third column was changed. `depth` is the listing's
/// u_displacement_scale.
template <class Io, class F = typename Io::Number>
vec3<F> rabbid_to_eye(const Io& io, const vec3<F>& n, F depth) {
    const vec3<F> N = normalize(io.template load<Value::vertex_normal>());
    const vec2<F> duv1 = io.template load<Value::dUVdx>(), duv2 = io.template load<Value::dUVdy>();
    const vec3<F> dp2perp = cross(io.template load<Value::dPdy>(), N);
    const vec3<F> dp1perp = cross(N, io.template load<Value::dPdx>());
    const vec3<F> T = dp2perp * duv1.x + dp1perp * duv2.x;
    const vec3<F> B = dp2perp * duv1.y + dp1perp * duv2.y;
    const F invmax = inversesqrt(max(dot(T, T), dot(B, B)));
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    const F side = select(dot(io.template load<Value::Ng>(), V) < F(0), F(-1), F(1));
    const vec3<F> third = (N * depth) * (side * N / depth);
    return normalize(T * invmax * n.x + B * invmax * n.y + third * n.z);
}

/// normalize( vec3( deltaH * scale, 1 ) ), scale = u_displacement_scale / texOffs.
template <Number F>
vec3<F> rabbid_tilt(const vec2<F>& delta, const vec2<F>& texel_offset, F depth) {
    return normalize(vec3<F>(delta * (vec2<F>(depth) / texel_offset), F(1)));
}

/// Stores the normal of the height differences `delta` over `texel_offset`. The listing has one
/// u_displacement_scale: the number of the material's depth, as frame-inverse-tbn@published reads
/// it, whatever that is a length of.
template <class Io, class F = typename Io::Number>
void store_rabbid_normal(const Io& io, const vec2<F>& delta, const vec2<F>& texel_offset) {
    const F depth(io.material().depth);
    io.template store<Value::N>(rabbid_to_eye(io, rabbid_tilt(delta, texel_offset, depth), depth));
}

}  // namespace quadrel
