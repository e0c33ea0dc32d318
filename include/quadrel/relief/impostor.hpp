// The volume of an impostor: solids between depth layers, in the frame of an object whose polygon
// is a card that turns to the camera.
//
// The card (billboard.hpp) goes through the object's origin, in the middle of its square of texture
// space, which is as large as a tile of the layers. The layers lie across the object's z axis: u
// grows along x, v along y, s against z; the origin is in the middle of all three. The transform
// keeps angles, so that a tile has one length.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// What the volume is made of. Stages that read more list it after these.
inline constexpr auto impostor_inputs =
    values(Value::P, Value::uv, Value::face_J, Value::object_x, Value::object_y, Value::object_z,
           Value::relief_depth);

/// In eye space; null vectors and gradients where the card has no UV.
template <Number F>
struct ImpostorVolume {
    vec3<F> x, y, z;         ///< unit, along growing u and v, and towards the top of the layers
    F tile;                  ///< world units of u or v; 0 where there are none
    vec3<F> grad_u, grad_v;  ///< a world unit
    F grad_s;                ///< along -z: 1 / depth; 0 where there is no depth, or not of a number
    vec3<F> from_origin;     ///< the fragment's point on the card, from the object's origin
    Mask<F> valid;

    /// The fragment's point on the card, as (u, v, s).
    vec3<F> point() const { return vec3<F>(F(0.5f)) + along(from_origin); }
    /// How (u, v, s) change along a vector.
    vec3<F> along(const vec3<F>& v) const {
        return {dot(grad_u, v), dot(grad_v, v), -(dot(z, v) * grad_s)};
    }
};

template <class Io, class F = typename Io::Number>
ImpostorVolume<F> impostor_volume(const Io& io) {
    const auto J = io.template load<Value::face_J>();
    const vec2<F> uv = io.template load<Value::uv>();
    const F depth = io.template load<Value::relief_depth>();
    const vec3<F> zero(F(0));
    const F scale = ordinary_scale(J[0], J[1]);
    const F density = length(cross(J[0] * scale, J[1] * scale));
    ImpostorVolume<F> volume;
    volume.valid = density > F(0);
    // The root of the area that a unit of UV covers.
    const F tile = select(volume.valid, scale / sqrt(density), F(0));
    volume.tile = tile;
    const auto axis = [&](const vec3<F>& v) {
        const F size = largest_component(v);
        volume.valid = volume.valid & (size > F(0));
        return select(volume.valid, normalize(v * ordinary_scale(size)), zero);
    };
    volume.x = axis(io.template load<Value::object_x>());
    volume.y = axis(io.template load<Value::object_y>());
    volume.z = axis(io.template load<Value::object_z>());
    volume.grad_u = select(volume.valid, volume.x / tile, zero);
    volume.grad_v = select(volume.valid, volume.y / tile, zero);
    const F inverse = F(1) / depth;
    volume.grad_s = select((depth > F(0)) & is_finite(inverse), inverse, F(0));
    volume.from_origin = (J[0] * tile * (uv.x - F(0.5f)) + J[1] * tile * (uv.y - F(0.5f))) * tile;
    return volume;
}

}  // namespace quadrel
