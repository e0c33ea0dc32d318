// What the words of searches mean on ranges: every step is made, and differences that are nothing
// but rounding are told by float32's.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/quad/range_interpolate.hpp"
#include "quadrel/relief/frame/store.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/near_surface.hpp"
#include "quadrel/texture/range/cube.hpp"

namespace quadrel {

template <Number F, class Height>
requires std::same_as<F, Ranges> Steps steps_near_surface(const Height&, const LatticeRays<F>&,
                                                          const Mask<F>&, int first, int last,
                                                          Before = Before::not_needed) {
    return steps<F>(first, last);
}
template <Number F, class Height>
requires std::same_as<F, Ranges> Steps steps_near_surface(const Height&, const SearchRay<F>&,
                                                          const Mask<F>&, F, int last,
                                                          Before = Before::not_needed) {
    return steps<F>(0, last);
}
template <Before before, class Along, class Position, class Heights>
class StepsOnCourse<Ranges, before, Along, Position, Heights> : public Steps {
  public:
    StepsOnCourse(const Along&, Position&, const Heights&, const RangeMask&, int first, int last,
                  const Ranges&)
        : Steps(first, last) {}
};

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
