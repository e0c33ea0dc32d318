// The view ray in texture space as Rabbid76's listings have it.
#pragma once

#include "quadrel/relief/frame/cot_published.hpp"

namespace quadrel {

template <Number F>
struct RabbidDirection {
    UvDirections<F> axes;  ///< columns of tbnMat: gradients of u and v, scaled to a common length
    vec3<F> N;             ///< unit, never flipped
    mat3<F> inverted;      ///< inverse( tbnMat )
    vec3<F> texDir3D;
};

/// Whether the listing displaces at all: abs(u_displacement_scale) is not less than 0.001.
inline bool rabbid_displaces(const MaterialUniforms& material) { return material.depth >= 0.001f; }

/// texDir3D = normalize( inverse( tbnMat ) * objPosEs ), tbnMat = (T invmax, B invmax, N scale);
/// the scale is the number of the material's depth.
template <class Io, class F = typename Io::Number>
RabbidDirection<F> rabbid_direction(const Io& io) {
    RabbidDirection<F> ray;
    ray.N = normalize(io.template load<Value::vertex_normal>());
    ray.axes = scale_invariant_frame(
        cotangent_rows(io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
                       io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>(), ray.N));
    ray.inverted = inverse(mat3<F>(ray.axes.T, ray.axes.B, ray.N * F(io.material().depth)));
    ray.texDir3D = normalize(ray.inverted * io.template load<Value::P>());
    return ray;
}

}  // namespace quadrel
