// The view vector, shared by every frame and shading text.
#pragma once

#include "quadrel/relief/rooms.hpp"

namespace quadrel {

/// Unit vector from the surface point towards the eye (V; the thesis calls it E).
template <Number F>
vec3<F> to_viewer(const vec3<F>& P, const auto& frame) {
    const vec3<F> eye = uniform3<F>(frame.eye);
    return normalize(frame.orthographic ? eye : eye - P);
}

/// Unit vector from `P` towards a light.
template <Number F>
vec3<F> to_light(const vec3<F>& P, const auto& light) {
    const vec3<F> position = uniform3<F>(light.position);
    return normalize(light.directional ? position : position - P);
}

/// Adds 1 in the lanes of `mask`.
template <Number F>
void count_in(Int<F>& counter, Mask<F> mask) {
    counter = counter + select(mask, Int<F>(1), Int<F>(0));
}

/// The flag of hit.flags in the lanes where a coordinate is not a number: a look-up there gives one
/// texel or another, as the implementation likes.
template <int size, Number F>
Int<F> nan_look_up_flag(const vec<size, F>& coordinate) {
    Mask<F> nan = is_nan(coordinate[0]);
    for (int i = 1; i < size; ++i) nan = nan | is_nan(coordinate[i]);
    return select(nan, Int<F>(HitFlag::nan_look_up), Int<F>(0));
}

/// A status in every lane.
template <Number F>
Int<F> status_packet(Status status) {
    return Int<F>(static_cast<std::int32_t>(status));
}

}  // namespace quadrel
