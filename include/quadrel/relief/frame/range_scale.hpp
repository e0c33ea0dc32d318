// Scales and tolerances of frames on ranges: which differences are nothing but rounding is told by
// float32's.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// Ranges are of doubles, in which nothing overflows that floats hold.
template <>
inline Ranges ordinary_scale<Ranges>(Ranges) {
    return Ranges(1);
}
template <>
inline Ranges ordinary_scale<Ranges>(const vec3<Ranges>&, const vec3<Ranges>&) {
    return Ranges(1);
}
template <>
inline Ranges length_at_any_scale<Ranges>(const vec3<Ranges>& v) {
    return length(v);
}

template <>
inline Ranges degenerate_tolerance<Ranges>() {
    const bool single = range_context().budget.unit > 0;
    return Ranges(8 * (single ? double(std::numeric_limits<float>::epsilon())
                              : std::numeric_limits<double>::epsilon()));
}

}  // namespace quadrel
