// The meeting of a ray with one bilinear patch, the leaf of every exact search.
//
// In the cell, (f, g) in [0, 1]^2, the field is h = a + b f + c g + d f g. Along the ray, tau = s -
// s at entry, it is met where
//     q(tau) = h(f + Dx tau, g + Dy tau) - (1 - s) = A tau^2 + B tau + C
// is 0; the hit is the least tau in [0, length] with q >= 0. The root is taken in the form without
// cancellation: Goldberg, "What Every Computer Scientist Should Know About Floating-Point
// Arithmetic", 1991. Bilinear patches along rays: Ramsey, Potter, Hansen, "Ray Bilinear Patch
// Intersections", JGT 9(3), 2004.
#pragma once

#include "quadrel/relief/cells.hpp"

namespace quadrel {

/// Half an ulp of 1: the relative error of one rounding.
template <Number F>
inline constexpr Scalar<F> unit_roundoff = std::numeric_limits<Scalar<F>>::epsilon() / 2;

/// The part of a ray that lies in a cell.
template <Number F>
struct PatchRay {
    vec2<F> entry;  ///< position in the cell where it begins, [0, 1]^2
    vec2<F> rate;   ///< cells per unit of s
    vec2<F> slack;  ///< how far off, in cells, the position may be
    F s;            ///< where it begins
    F length;       ///< in s, >= 0
    Mask<F> last;   ///< it ends at s = 1, the bottom plane
};

template <Number F>
struct PatchHit {
    F tau, height;       ///< where `hit`; height is the field's there
    Mask<F> hit;         ///< q(tau) >= 0 somewhere in the part, or it ends where every ray has hit
    Mask<F> ambiguous;   ///< a graze: q is highest, at entry or in the part, at 0 but for rounding
    Mask<F> not_finite;  ///< a corner's height is NaN or infinite; no hit then
};

/// Height at (f, g) of a patch, first along x. Between non-negative corners it is non-negative, and
/// a constant is kept.
template <Number F>
F patch_height(const CellHeights<F>& h, const vec2<F>& at) {
    return lerp(lerp(h.h00, h.h10, at.x), lerp(h.h01, h.h11, at.x), at.y);
}

/// At tau of a part.
template <Number F>
F height_in_part(const CellHeights<F>& h, const PatchRay<F>& ray, F tau) {
    return patch_height(h, clamp(ray.entry + ray.rate * tau, F(0), F(1)));
}

template <Number F>
struct PatchQuadratic {
    F A, B, C, discriminant;
};

/// The field less the height of a ray that is at `height` where its part begins and climbs by
/// `rise` a unit of s.
template <Number F>
PatchQuadratic<F> patch_quadratic(const CellHeights<F>& h, const PatchRay<F>& ray, F height,
                                  F rise) {
    const F b = h.h10 - h.h00, c = h.h01 - h.h00, d = (h.h11 - h.h01) - b;
    PatchQuadratic<F> q;
    q.A = d * ray.rate.x * ray.rate.y;
    q.B = b * ray.rate.x + c * ray.rate.y +
          d * (ray.entry.x * ray.rate.y + ray.entry.y * ray.rate.x) - rise;
    q.C = patch_height(h, ray.entry) - height;
    q.discriminant = q.B * q.B - F(4) * q.A * q.C;
    return q;
}
/// Of a view ray.
template <Number F>
PatchQuadratic<F> patch_quadratic(const CellHeights<F>& h, const PatchRay<F>& ray) {
    return patch_quadratic(h, ray, F(1) - ray.s, F(-1));
}

/// The greatest value of q from where the part begins to where it ends.
template <Number F>
F greatest(const PatchQuadratic<F>& q, F length) {
    const F vertex = F(-0.5f) * q.B / q.A;
    const Mask<F> peaks = (q.A < F(0)) & (vertex > F(0)) & (vertex < length);
    const F end = (q.A * length + q.B) * length + q.C;
    return max(max(q.C, end), select(peaks, q.C + F(0.5f) * q.B * vertex, q.C));
}

/// First root of q where C < 0; infinite, negative or NaN where there is none ahead.
template <Number F>
F first_root(const PatchQuadratic<F>& q) {
    const F root = sqrt(max(q.discriminant, F(0)));
    // A > 0 has one root ahead, whatever B. A < 0 has two ahead or none: B + root < 0 then.
    const Mask<F> convex_descent = (q.A > F(0)) & (q.B < F(0));
    return select(convex_descent, root - q.B, F(-2) * q.C) /
           select(convex_descent, F(2) * q.A, q.B + root);
}

/// Bound on the error of q at its greatest in a patch: of its evaluation, and of the position.
template <Number F>
F patch_error(const CellHeights<F>& h, const vec2<F>& slack) {
    const F highest = max(max(abs(h.h00), abs(h.h10)), max(abs(h.h01), abs(h.h11)));
    const F slope_x = max(abs(h.h10 - h.h00), abs(h.h11 - h.h01));
    const F slope_y = max(abs(h.h01 - h.h00), abs(h.h11 - h.h10));
    return F(32 * unit_roundoff<F>) * (F(1) + highest) + slope_x * slack.x + slope_y * slack.y;
}

/// The greatest value of q in a part that ends with q = `end`, and where q is C at entry.
template <Number F>
F peak_of_part(const PatchQuadratic<F>& q, F end, F length) {
    const F vertex = F(-0.5f) * q.B / q.A;
    const Mask<F> peaks = (q.A < F(0)) & (vertex > F(0)) & (vertex < length);
    return max(max(q.C, end), select(peaks, q.C + F(0.5f) * q.B * vertex, q.C));
}

template <Number F>
Mask<F> is_graze(const CellHeights<F>& h, const PatchRay<F>& ray, const PatchQuadratic<F>& q,
                 F end) {
    const F peak = peak_of_part(q, end, ray.length);
    const F error = patch_error(h, ray.slack);
    // A part that comes down to where the ray ends, and is highest there, is no graze.
    const Mask<F> comes_down = ray.last & (peak == end) & (q.C < -error);
    // A ray that touches at entry and rises from there may come back further on.
    const Mask<F> touches_entry = (abs(q.C) <= error) & (q.B < F(0));
    return ((abs(peak) <= error) & !comes_down) | touches_entry;
}

/// Where a ray meets a patch along a part, with q there and its value `end` where the part ends;
/// `at_end`: if nowhere before, there. `tells_grazes`: whether anyone asks what is ambiguous; else
/// nothing is.
template <Number F>
PatchHit<F> meet_quadratic(const CellHeights<F>& h, const PatchRay<F>& ray,
                           const PatchQuadratic<F>& q, F end, Mask<F> at_end, bool tells_grazes) {
    const F root = first_root(q);
    const Mask<F> below_at_entry = q.C >= F(0);
    const Mask<F> crossed = (q.discriminant >= F(0)) & (root >= F(0)) & (root <= ray.length);
    PatchHit<F> found;
    found.not_finite = !is_finite((h.h00 + h.h10) + (h.h01 + h.h11));
    found.hit = (below_at_entry | crossed | at_end) & !found.not_finite;
    found.tau = select(below_at_entry, F(0), select(crossed, root, ray.length));
    found.height = height_in_part(h, ray, found.tau);
    found.ambiguous = Mask<F>(false);
    if (tells_grazes) found.ambiguous = is_graze(h, ray, q, end);
    return found;
}

/// Of a view ray.
template <Number F>
PatchHit<F> intersect_patch(const CellHeights<F>& h, const PatchRay<F>& ray,
                            bool tells_grazes = true) {
    const F end_height = height_in_part(h, ray, ray.length);
    const F end = end_height - (F(1) - (ray.s + ray.length));
    // Heights are not negative, so at the bottom plane every ray has hit.
    const Mask<F> at_bottom = ray.last & (end_height >= F(0));
    return meet_quadratic(h, ray, patch_quadratic(h, ray), end, at_bottom, tells_grazes);
}

}  // namespace quadrel
