// The samples of a packet's rays: evenly spaced points that a search tests one after the other.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Sample k of a ray is at uv + uv_step k, but for rounding, and its height is height + height_step
/// k.
template <Number F>
struct LatticeRays {
    vec2<F> uv, uv_step;
    F height, height_step;
    vec2<F> reach;  ///< no coordinate is a product of a factor below 1 and more than this
    F last;         ///< a lane's last sample, which is part of its result; infinite if it has none
};

/// Samples at s = k / n; the last one, per lane, at s = 1 or at step `last`.
template <Number F>
LatticeRays<F> even_steps_down(const SearchRay<F>& ray, F n, int last) {
    const F part = F(1) / n;
    return {ray.uv - ray.K * F(ray.s_polygon), ray.K * part, F(1), -part, ray.K,
            min(ceil(n), number<F>(last))};
}

/// Whether a text reads, at a sample, what it found at the one before.
enum class Before { not_needed, needed };

/// What the last look-up of a march gave.
template <Number F>
struct LastLook {
    vec2<F> uv = vec2<F>(F(0));
    F gap = F(0);  ///< of the ray above the surface
};

}  // namespace quadrel
