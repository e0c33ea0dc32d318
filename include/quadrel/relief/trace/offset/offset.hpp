// What shifts without a search share: one height, and what they report. A shift has no hit, so
// hit.s = 1 - h says at which depth the height would lie that caused it. At the shifted UV the
// surface is elsewhere: a shadow march from there finds itself in the ground or in the air, so that
// scenes with shifts leave self-shadows out, as the sources do.
#pragma once

#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

/// The height at the undisplaced UV, tested as the first and only step.
template <class Io, class F = typename Io::Number>
F height_at_start(const Io& io, const SearchRay<F>& ray) {
    const F h = march_heights(io)(ray.active, ray.uv);
    io.march_step(ray.active, F(ray.s_polygon), ray.uv, F(1) - F(ray.s_polygon), h);
    return h;
}

/// The same by a look-up with implicit derivatives, where the source has texture() or tex2D().
template <class Io, class F = typename Io::Number>
F implicit_height_at_start(const Io& io, const SearchRay<F>& ray) {
    const F h = implicit_height(io, ray.active, ray.uv);
    io.march_step(ray.active, F(ray.s_polygon), ray.uv, F(1) - F(ray.s_polygon), h);
    return h;
}

/// HIT at s = 1 - h after one look-up; NAN where h is not a number.
template <Number F>
SearchResult<F> offset_result(const SearchRay<F>& ray, F h) {
    SearchResult<F> result;
    result.s = F(1) - h;
    result.h = h;
    result.status = search_status<F>(ray.active, is_nan(h));
    count_in<F>(result.steps, ray.active);
    result.fetches = result.steps;
    return result;
}

/// The undisplaced UV moved by (sigma - h) K, scaled: sigma is the height of the polygon.
template <Number F>
vec2<F> shifted_uv(const SearchRay<F>& ray, F h, F scale) {
    return ray.uv + ray.K * ((F(Scalar<F>(1) - ray.s_polygon) - h) * scale);
}

}  // namespace quadrel
