// The ray from a hit towards a light, in texture space: what every shadow search shares.
//
//     uv(t) = hit.uv + t K, height z + t, t in (0, 1 - z]; occluded where the field is above it.
#pragma once

#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

/// What light_ray loads. Rows that read more list it after these (light_ray_inputs_and).
inline constexpr auto light_ray_inputs =
    values(Value::relief_depth, Value::J, Value::frame_normal, Value::frame_status, Value::hit_uv,
           Value::hit_s, Value::hit_h, Value::hit_P);

template <class... V>
constexpr auto light_ray_inputs_and(V... more) {
    return values_and(light_ray_inputs, more...);
}

/// A shadow by a march whose look-ups have gradients, over heights where a row names no other map.
struct MarchedShadow : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = light_ray_inputs_and(Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
};

template <Number F>
struct LightRay {
    vec3<F> L;         ///< unit, towards the light
    F r;               ///< L.N: world depth a unit of the ray's length
    vec2<F> K;         ///< UV shift while the ray climbs through the whole relief
    vec2<F> uv;        ///< of the hit
    F z;               ///< height of the hit: where the surface is, if a march stopped below it
    Mask<F> lit_side;  ///< the light is not behind the surface
    Mask<F> active;    ///< lanes whose light may be occluded: lit side, a frame, a depth
};

template <class Io, class F = typename Io::Number>
LightRay<F> light_ray(const Io& io) {
    LightRay<F> ray;
    ray.L = to_light(io.template load<Value::hit_P>(), io.frame().lights[io.light()]);
    ray.r = dot(ray.L, io.template load<Value::frame_normal>());
    const auto J = io.template load<Value::J>();
    const F depth = io.template load<Value::relief_depth>();
    ray.K = vec2<F>(dot(J[0], ray.L), dot(J[1], ray.L)) / ray.r * depth;
    ray.uv = io.template load<Value::hit_uv>();
    ray.z = max(F(1) - io.template load<Value::hit_s>(), io.template load<Value::hit_h>());
    ray.lit_side = ray.r > F(0);
    const Mask<F> framed = io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
    ray.active = io.active() & ray.lit_side & framed & (depth != F(0));
    return ray;
}

/// Samples at t = (k + offset) / n of the way to where the ray has climbed by `rise`.
template <Number F>
LatticeRays<F> even_steps_up(const LightRay<F>& ray, F n, F offset = F(0), F rise = F(1)) {
    const F part = rise / n, start = offset * part;
    return {ray.uv + ray.K * start,
            ray.K * part,
            ray.z + start,
            part,
            ray.K,
            F(std::numeric_limits<Scalar<F>>::infinity())};
}

/// Samples at t = top (1 - k / n): from there back to the hit.
template <Number F>
LatticeRays<F> even_steps_back(const LightRay<F>& ray, F top, F n) {
    const F part = top / n;
    return {ray.uv + ray.K * top,
            -(ray.K * part),
            ray.z + top,
            -part,
            ray.K,
            F(std::numeric_limits<Scalar<F>>::infinity())};
}

/// Stores visibility, 0 behind the surface, and the number of points that were tested.
template <class Io, class F = typename Io::Number>
void store_shadow(const Io& io, const LightRay<F>& ray, F visibility, Int<F> steps) {
    io.template store<Value::shadow_visibility>(select(ray.lit_side, visibility, F(0)), io.light());
    io.template store<Value::shadow_steps>(steps, io.light());
}

}  // namespace quadrel
