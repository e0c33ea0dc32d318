// The eye as listings in tangent space have it.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

/// What tangent_eye loads.
inline constexpr auto tangent_eye_inputs =
    values(Value::P, Value::T, Value::B, Value::frame_normal);

/// From the surface point to the eye (or towards the viewer), not normalised, along the frame's
/// tangent, bitangent and normal. Listings presume that these run along growing u and v and that a
/// UV unit is as long on both, so use a frame for which that holds.
template <class Io, class F = typename Io::Number>
vec3<F> tangent_eye(const Io& io) {
    const vec3<F> eye = uniform3<F>(io.frame().eye);
    const vec3<F> e = io.frame().orthographic ? eye : eye - io.template load<Value::P>();
    return {dot(e, io.template load<Value::T>()), dot(e, io.template load<Value::B>()),
            dot(e, io.template load<Value::frame_normal>())};
}

}  // namespace quadrel
