// A walk down a ray in safe steps: what the corrected cone searches share.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

/// Where each lane is.
template <Number F>
struct ConeWalk {
    F s = F(0), previous = F(0);  ///< the point tested last, and the one before it
    Mask<F> active, met_nan = Mask<F>(false), found = Mask<F>(false);
    SearchResult<F> result;

    explicit ConeWalk(Mask<F> lanes) : active(lanes) {}

    /// Takes in the height at s. Lanes within `tolerance` of the surface or below it have found it.
    void test(F height, F tolerance) {
        result.h = select(active, height, result.h);
        count_in<F>(result.steps, active);
        met_nan = met_nan | (active & is_nan(height));
        const Mask<F> ends = active & ((F(1) - s) - height <= tolerance);
        found = found | ends;
        active = active & !ends & !is_nan(height);
    }
    /// Lanes whose step would end below the bottom plane are set on it.
    void fall(F by) {
        previous = select(active, s, previous);
        s = select(active, min(s + by, F(1)), s);
    }
};

/// Walks at most `most` points: `cone(active, s, uv)` looks up, `fall(cone, gap, uv)` says how far
/// on. Lanes that are still above the surface after that have status CAP.
template <Number F, class Look, class Fall>
ConeWalk<F> walk_cones(const SearchRay<F>& ray, const Look& cone, const Fall& fall, int most,
                       F tolerance) {
    ConeWalk<F> walk(ray.active);
    for (const auto k : steps<F>(1, most)) {
        const vec2<F> uv = ray.at(walk.s);
        const Cone<F> here = cone(walk.active, walk.s, uv);
        walk.test(here.height, tolerance);
        if (none(walk.active)) break;
        walk.fall(fall(here, (F(1) - walk.s) - here.height, uv));
    }
    walk.result.s = walk.s;
    walk.result.status = search_status<F>(walk.found, walk.met_nan, Status::cap);
    walk.result.fetches = walk.result.steps;
    return walk;
}

/// A gap that rounding leaves where a ray has fallen all the way down to a height: a search without
/// tolerance would stay above it for ever.
template <Number F>
inline constexpr Scalar<F> rounding_gap = 2 * std::numeric_limits<Scalar<F>>::epsilon();

/// How far a ray may fall by the cone under it.
template <Number F>
auto fall_by_cone(const SearchRay<F>& ray) {
    return [kappa = length(ray.K)](const Cone<F>& cone, F gap, const vec2<F>&) {
        return cone_step_length(gap, cone.ratio, kappa);
    };
}

/// The same, but to the next border between texel centres of a map of `size` texels at least, times
/// `relax`.
template <Number F>
auto fall_from_patch_to_patch(const SearchRay<F>& ray, const vec2<F>& size, F relax = F(1)) {
    return [K = ray.K, kappa = length(ray.K), size, relax](const Cone<F>& cone, F gap,
                                                           const vec2<F>& uv) {
        const F along = cone_step_length(gap, cone.ratio, kappa);
        const F step = max(along, fall_to_cell_border(uv, K, size));
        return select(kappa > F(0), step * relax, along);
    };
}

/// Halves the last step `times` times where it ended below the surface.
template <Number F, class Look>
void bisect_last_step(const SearchRay<F>& ray, const Look& cone, int times, ConeWalk<F>& walk) {
    F above = walk.previous, below = walk.s;
    const Mask<F> lanes = walk.found & (below > above);
    for (const auto k : steps<F>(1, times)) {
        if (none(lanes)) break;
        const F middle = (above + below) * F(0.5f);
        const F height = cone(lanes, middle, ray.at(middle)).height;
        const Mask<F> under = height >= F(1) - middle;
        below = select(lanes & under, middle, below);
        walk.result.h = select(lanes & under, height, walk.result.h);
        above = select(lanes & !under, middle, above);
        count_in<F>(walk.result.fetches, lanes);
        count_in<F>(walk.result.steps, lanes);
    }
    walk.result.s = select(lanes, below, walk.result.s);
}

}  // namespace quadrel
