// What the stages of each room store, so that any of a room can take another's place.
#pragma once

#include "quadrel/quad/stage.hpp"

namespace quadrel {

/// A list of values and more after it.
template <std::size_t n, class... V>
constexpr auto values_and(const std::array<Value, n>& list, V... more) {
    std::array<Value, n + sizeof...(V)> all{};
    std::copy(list.begin(), list.end(), all.begin());
    std::size_t next = n;
    ((all[next++] = more), ...);
    return all;
}

/// frame: P, normals and derivatives to the UV shift along the view ray.
inline constexpr auto frame_outputs =
    values(Value::T, Value::B, Value::frame_normal, Value::J, Value::r, Value::uv_rate, Value::K,
           Value::frame_status, Value::frame_flags);

/// A frame of the derivatives of P and UV, face and vertex normal.
struct DerivativeFrame : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::dPdx, Value::dPdy, Value::dUVdx,
               Value::dUVdy, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
};

/// oracle: the ray to where it first meets the height field, with proof.
inline constexpr auto oracle_outputs =
    values(Value::oracle_s, Value::oracle_uv, Value::oracle_cell, Value::oracle_place,
           Value::oracle_gradient, Value::oracle_condition, Value::oracle_bound,
           Value::oracle_status, Value::certified, Value::certified_reason);

/// trace: the height field and the ray to the hit.
inline constexpr auto trace_outputs =
    values(Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_depth, Value::hit_status,
           Value::hit_flags, Value::hit_steps, Value::hit_fetches);

/// A search over the height map that reads no other.
struct HeightSearch : StageDefaults {
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
};

/// surface: the hit to the shading normal.
inline constexpr auto surface_outputs = values(Value::N);

/// The normal of heights.
struct NormalFromHeights : StageDefaults {
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
};

/// The normal of a normal map.
struct NormalFromMap : StageDefaults {
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures = slots(TextureSlot::normal);
};

/// shadow: hit and light to visibility, one light at a time.
inline constexpr auto shadow_outputs = values(Value::shadow_visibility, Value::shadow_steps);

/// occlusion: the hit to its ambient visibility.
inline constexpr auto occlusion_outputs = values(Value::occlusion);

/// shade: everything to colour; models without the thesis' terms store the last two alone.
inline constexpr auto shade_outputs =
    values(Value::light_ambient, Value::light_diffuse, Value::light_specular, Value::light_emissive,
           Value::light_reflection, Value::light_refraction, Value::color, Value::opacity);

}  // namespace quadrel
