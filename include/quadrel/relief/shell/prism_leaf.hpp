// The meeting of a ray with the heights of one cell, for rays that fall, rise or run level: with a
// bilinear patch, or with two triangles on either side of a diagonal.
#pragma once

#include "quadrel/relief/trace/exact/patch.hpp"

namespace quadrel {

/// What lies between texel centres.
enum class PrismSurface : std::int32_t {
    bilinear,
    tri_main,  ///< two triangles, their edge from (i, j) to (i+1, j+1)
    tri_anti,  ///< from (i+1, j) to (i, j+1)
};

/// Height of a ray over its part in a cell.
template <Number F>
struct PartHeight {
    F at_entry, rise;  ///< and a unit of the ray's parameter
};

/// Height at (f, g) of a cell that is split along a diagonal.
template <Number F>
F split_height(const CellHeights<F>& h, const vec2<F>& at, bool main_diagonal) {
    const F f = main_diagonal ? at.x : F(1) - at.x, g = at.y;
    const F h00 = main_diagonal ? h.h00 : h.h10, h10 = main_diagonal ? h.h10 : h.h00;
    const F h01 = main_diagonal ? h.h01 : h.h11, h11 = main_diagonal ? h.h11 : h.h01;
    // From the corner that both triangles have, along the sides of the one at hand.
    const F lower = (h00 + (h10 - h00) * f) + (h11 - h10) * g;
    const F upper = (h00 + (h01 - h00) * g) + (h11 - h01) * f;
    return select(g > f, upper, lower);
}

/// Of a function that is linear between its values at 0, `bend` and `length`, in the lanes where it
/// begins below 0: the first point where it is 0, infinite if it stays below.
template <Number F>
F first_zero(F start, F at_bend, F end, F bend, F length) {
    const F never(std::numeric_limits<Scalar<F>>::infinity());
    const F early = bend * (start / (start - at_bend));
    const F late = bend + (length - bend) * (at_bend / (at_bend - end));
    return select(at_bend >= F(0), min(early, bend),
                  select(end >= F(0), clamp(late, bend, length), never));
}

/// `ends_below`: the part ends where no height is below the ray.
template <Number F>
PatchHit<F> meet_patch(const CellHeights<F>& h, const PatchRay<F>& part, const PartHeight<F>& ray,
                       Mask<F> ends_below, bool tells_grazes) {
    const F end = height_in_part(h, part, part.length) - (ray.at_entry + ray.rise * part.length);
    return meet_quadratic(h, part, patch_quadratic(h, part, ray.at_entry, ray.rise), end,
                          ends_below | (end >= F(0)), tells_grazes);
}

template <Number F>
PatchHit<F> meet_triangles(const CellHeights<F>& h, const PatchRay<F>& part,
                           const PartHeight<F>& ray, Mask<F> ends_below, bool tells_grazes,
                           bool main_diagonal) {
    const auto position = [&](F tau) { return clamp(part.entry + part.rate * tau, F(0), F(1)); };
    const auto above = [&](F tau) {
        return split_height(h, position(tau), main_diagonal) - (ray.at_entry + ray.rise * tau);
    };
    // Where the ray crosses the diagonal.
    const F along = main_diagonal ? part.rate.x - part.rate.y : part.rate.x + part.rate.y;
    const F ahead =
        main_diagonal ? part.entry.y - part.entry.x : F(1) - (part.entry.x + part.entry.y);
    const F meets = ahead / along;
    const F bend = select((meets > F(0)) & (meets < part.length), meets, F(0));
    const F start = above(F(0)), at_bend = above(bend), end = above(part.length);
    const F zero = select(start >= F(0), F(0), first_zero(start, at_bend, end, bend, part.length));
    PatchHit<F> found;
    found.not_finite = !is_finite((h.h00 + h.h10) + (h.h01 + h.h11));
    found.hit = ((zero <= part.length) | ends_below) & !found.not_finite;
    found.tau = min(zero, part.length);
    found.height = split_height(h, position(found.tau), main_diagonal);
    found.ambiguous = Mask<F>(false);
    if (tells_grazes) {
        const F highest = max(start, max(at_bend, end)), error = patch_error(h, part.slack);
        found.ambiguous = abs(highest) <= error;
    }
    return found;
}

}  // namespace quadrel
