// What the frames of published programs share. Their height scale is a length in UV, one unit of
// texture coordinates, where the frames of this renderer take a length in the world.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// Stores T, B, N, K and r as a program has them. `grad_u`, `grad_v` are its unit axes, a unit of
/// UV long; the number of the material's depth, thickness over tile size, is its height scale, and
/// the world's depth of the relief stays relief_depth. The programs know neither degenerate maps
/// nor back faces: the status is HIT, whatever K; nor fading, which changes relief_depth alone.
template <class Io, class F = typename Io::Number>
void store_published_frame(const Io& io, const UvDirections<F>& axes, const vec3<F>& N,
                           const SurfaceJacobian<F>& unit_j, F r, const vec2<F>& K) {
    const F depth = io.template load<Value::relief_depth>();
    const Mask<F> deep = depth > F(0);
    const F tiles_per_length = select(deep, F(io.material().depth) / depth, F(0));
    io.template store<Value::T>(axes.T);
    io.template store<Value::B>(axes.B);
    io.template store<Value::frame_normal>(N);
    io.template store<Value::J>(
        std::array<vec3<F>, 2>{unit_j.grad_u * tiles_per_length, unit_j.grad_v * tiles_per_length});
    io.template store<Value::r>(r);
    io.template store<Value::uv_rate>(select(deep, K / depth, vec2<F>(F(0))));
    io.template store<Value::K>(K);
    io.template store<Value::frame_status>(status_packet<F>(Status::hit));
    io.template store<Value::frame_flags>(Int<F>(0));
}

}  // namespace quadrel
