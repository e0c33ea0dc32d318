// The ray from a hit in the volume of an impostor towards a light: any way through the cube of
// (u, v, s), since what is lit from behind or along the layers is so by its own shape.
#pragma once

#include "quadrel/relief/trace/layer/impostor_layers.hpp"

namespace quadrel {

inline constexpr auto impostor_light_inputs =
    values_and(impostor_inputs, Value::frame_status, Value::hit_uv, Value::hit_s, Value::hit_P);

template <Number F>
struct ImpostorLight {
    vec3<F> from;    ///< (u, v, s)
    vec3<F> way;     ///< how they change until the ray leaves the cube, or is at the light
    Mask<F> active;  ///< there is a way

    vec3<F> place(F t) const { return from + way * t; }
};

/// From (u, v, s) of a hit, or of what is there in its place.
template <class Io, class F = typename Io::Number>
ImpostorLight<F> impostor_light(const Io& io, const vec3<F>& from) {
    const ImpostorVolume<F> volume = impostor_volume(io);
    const vec3<F> P = io.template load<Value::hit_P>();
    const auto& light = io.frame().lights[io.light()];
    const vec3<F> rate = volume.along(to_light(P, light));
    F until(std::numeric_limits<Scalar<F>>::infinity());
    if (!light.directional) until = length_at_any_scale(uniform3<F>(light.position) - P);
    RayPart<F> part(F(0), until);
    for (int axis = 0; axis < 3; ++axis) part.clip(from[axis], rate[axis]);
    const Mask<F> framed = io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
    const Mask<F> active = io.active() & framed & (volume.grad_s > F(0)) & (part.from < part.to);
    return {from, rate * select(active, part.to, F(0)), active};
}

/// Stores visibility and the number of points that were tested.
template <class Io, class F = typename Io::Number>
void store_impostor_shadow(const Io& io, Mask<F> occluded, Int<F> points) {
    io.template store<Value::shadow_visibility>(select(occluded, F(0), F(1)), io.light());
    io.template store<Value::shadow_steps>(points, io.light());
}

}  // namespace quadrel
