// The view vector as shaders of engines have it.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

/// The unit vector from the surface point towards the viewer, along the frame's tangent, bitangent
/// and normal as they are; not normalised again. The stage loads P, T, B and frame_normal.
template <class Io, class F = typename Io::Number>
vec3<F> tangent_viewer(const Io& io) {
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    return {dot(V, io.template load<Value::T>()), dot(V, io.template load<Value::B>()),
            dot(V, io.template load<Value::frame_normal>())};
}

}  // namespace quadrel
