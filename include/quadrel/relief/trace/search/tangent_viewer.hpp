// The view vector as shaders of engines have it.
#pragma once

#include "quadrel/relief/trace/search/tangent_eye.hpp"

namespace quadrel {

/// The unit vector from the surface point towards the viewer, along the frame's tangent, bitangent
/// and normal as they are; not normalised again. The stage loads P, T, B and frame_normal.
template <class Io, class F = typename Io::Number>
vec3<F> tangent_viewer(const Io& io) {
    return along_frame(io, to_viewer(io.template load<Value::P>(), io.frame()));
}

}  // namespace quadrel
