// The eye as listings in tangent space have it.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {

/// What a search at level 0 loads that takes the viewer along the frame's axes.
inline constexpr auto tangent_search_inputs =
    values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);

/// A vector along the frame's tangent, bitangent and normal as they are. The stage loads T, B and
/// frame_normal.
template <class Io, class F>
vec3<F> along_frame(const Io& io, const vec3<F>& v) {
    return {dot(v, io.template load<Value::T>()), dot(v, io.template load<Value::B>()),
            dot(v, io.template load<Value::frame_normal>())};
}

/// From the surface point to the eye (or towards the viewer), not normalised, along the frame's
/// tangent, bitangent and normal. Listings presume that these run along growing u and v and that a
/// UV unit is as long on both, so use a frame for which that holds.
template <class Io, class F = typename Io::Number>
vec3<F> tangent_eye(const Io& io) {
    const vec3<F> eye = uniform3<F>(io.frame().eye);
    const vec3<F> e = io.frame().orthographic ? eye : eye - io.template load<Value::P>();
    return along_frame(io, e);
}

}  // namespace quadrel
