// The meeting of a ray with the solid between two bilinear patches of depths, the leaf of exact
// searches through layers.
//
// Along a part of the ray in one cell, tau = s - s at entry, two quadratics say where it is:
//     below(tau) = depth of the ray - front(tau),    above(tau) = back(tau) - depth of the ray;
// the solid is where below >= 0 and above > 0. Each of them comes up through 0 once at most, and
// where it does the other one is the solid's thickness there: so a ray enters where it begins
// inside, or at such a root where the thickness, below + above, is more than nothing. Downwards
// through a front, or sideways under a back that comes down faster than the ray.
#pragma once

#include "quadrel/relief/trace/exact/patch.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

/// The depth of a ray along a part: `depth` where the part begins, and its change a unit of s.
template <Number F>
struct RayDepth {
    F depth, rate;
};

/// Where a part of a ray is in the solid between two layers.
template <Number F>
struct SolidQuadratics {
    PatchQuadratic<F> below, above;

    F thickness(F tau) const {
        return ((below.A + above.A) * tau + (below.B + above.B)) * tau + (below.C + above.C);
    }
};

template <Number F>
SolidQuadratics<F> solid_quadratics(const CellHeights<F>& front, const CellHeights<F>& back,
                                    const PatchRay<F>& part, const RayDepth<F>& ray) {
    const PatchQuadratic<F> q = patch_quadratic(front, part, ray.depth, ray.rate);
    return {{-q.A, -q.B, -q.C, q.discriminant}, patch_quadratic(back, part, ray.depth, ray.rate)};
}

template <Number F>
F value_at(const PatchQuadratic<F>& q, F tau) {
    return (q.A * tau + q.B) * tau + q.C;
}

/// q less e.
template <Number F>
PatchQuadratic<F> lowered(const PatchQuadratic<F>& q, F e) {
    const F C = q.C - e;
    return {q.A, q.B, C, q.B * q.B - F(4) * q.A * C};
}
/// The solid with e taken off either side.
template <Number F>
SolidQuadratics<F> inset(const SolidQuadratics<F>& solid, F e) {
    return {lowered(solid.below, e), lowered(solid.above, e)};
}

/// Where q comes up through 0 (first_root gives no other root), and whether that is in the part and
/// enters the solid.
template <Number F>
struct SolidCrossing {
    F tau;
    Mask<F> enters;
};
template <Number F>
SolidCrossing<F> upward_crossing(const SolidQuadratics<F>& solid, const PatchQuadratic<F>& q,
                                 F length) {
    const F tau = first_root(q);
    const Mask<F> ahead = (q.discriminant >= F(0)) & (tau >= F(0)) & (tau <= length);
    return {tau, ahead & (solid.thickness(tau) > F(0))};
}

template <Number F>
struct SolidEntry {
    F tau;          ///< where `hit`; infinite elsewhere
    Mask<F> hit;    ///< it is inside somewhere in the part
    Mask<F> front;  ///< through the front; else through the back, or inside at the beginning and
                    ///< nearer to the back
    F slope;        ///< of the quadratic that comes up there; 0 where the part begins inside
};

/// Where q goes down through 0 for the last time; infinite where it does not.
template <Number F>
F last_descent(const PatchQuadratic<F>& q) {
    const F root = sqrt(max(q.discriminant, F(0)));
    const F never(std::numeric_limits<Scalar<F>>::infinity());
    return select((q.A < F(0)) & (q.discriminant >= F(0)), (q.B + root) / (F(-2) * q.A), never);
}

/// `at` where it is in the part and the ray is inside half-way from there to where it leaves, at
/// the end of the part or before; infinite elsewhere.
template <Number F>
F inside_behind(const SolidQuadratics<F>& solid, F at, F leaves) {
    const F middle = F(0.5f) * (at + leaves);
    const Mask<F> inside =
        (value_at(solid.below, middle) >= F(0)) & (value_at(solid.above, middle) > F(0));
    const Mask<F> ahead = (at >= F(0)) & (at <= leaves);
    return select(ahead & inside, at, F(std::numeric_limits<Scalar<F>>::infinity()));
}

template <Number F>
SolidEntry<F> enter_solid(const SolidQuadratics<F>& solid, F length) {
    const PatchQuadratic<F>&below = solid.below, &above = solid.above;
    const Mask<F> inside = (below.C >= F(0)) & (above.C > F(0));
    const auto down = upward_crossing(solid, below, length);
    const auto sideways = upward_crossing(solid, above, length);
    const F never(std::numeric_limits<Scalar<F>>::infinity());
    const F front = select(down.enters, down.tau, never);
    const F back = select(sideways.enters, sideways.tau, never);
    const Mask<F> crosses_front = front <= back;
    const F root = sqrt(max(select(crosses_front, below.discriminant, above.discriminant), F(0)));
    // At a rim, where front and back meet, both come up at once, and rounding may deny any
    // thickness there: the ray is inside behind it.
    const Mask<F> found = inside | down.enters | sideways.enters;
    const Mask<F> ends_inside =
        (value_at(below, length) >= F(0)) & (value_at(above, length) > F(0));
    const F leaves = min(min(last_descent(below), last_descent(above)), length);
    const F rim =
        min(min(inside_behind(solid, down.tau, leaves), inside_behind(solid, sideways.tau, leaves)),
            select(ends_inside, length, never));
    const Mask<F> behind_rim = rim <= length;
    SolidEntry<F> entry;
    entry.hit = found | behind_rim;
    entry.tau =
        select(inside, F(0), select(behind_rim & !found, rim, select(crosses_front, front, back)));
    entry.front = (inside & (below.C <= above.C)) | (crosses_front & !inside);
    entry.slope = select(inside, F(0), root);
    return entry;
}

/// Whether there is anything between the layers of a cell.
template <Number F>
Mask<F> is_solid(const CellHeights<F>& front, const CellHeights<F>& back) {
    return (front.h00 < back.h00) | (front.h10 < back.h10) | (front.h01 < back.h01) |
           (front.h11 < back.h11);
}

/// Bound on the error of both quadratics.
template <Number F>
F solid_error(const CellHeights<F>& front, const CellHeights<F>& back, const vec2<F>& slack) {
    return max(patch_error(front, slack), patch_error(back, slack));
}

/// Whether rounding could decide about the entry, or about another one before it: the solid with an
/// error more on either side is met, and with an error less it is not, or not by the same way.
template <Number F>
Mask<F> is_solid_grazed(const SolidQuadratics<F>& solid, F length, F error, F nearest) {
    const SolidEntry<F> more = enter_solid(inset(solid, -error), length);
    const SolidEntry<F> less = enter_solid(inset(solid, error), length);
    const F moved = (less.tau - more.tau) * less.slope;
    const Mask<F> jumps = (moved > F(8) * error) | !less.hit;
    return more.hit & (more.tau <= nearest) & jumps;
}

}  // namespace quadrel
