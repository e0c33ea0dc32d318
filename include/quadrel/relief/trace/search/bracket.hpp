// What marches in steps share: the first pair of neighbouring samples of which one is above the
// surface and the next at or below it, and the ways to narrow that pair down.
//
// Samples are indexed, not accumulated: s = k / n, so the last one is exactly the bottom plane. A
// NaN height is never at or above the ray.
#pragma once

#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

/// The neighbouring samples of a march between which a ray enters the surface.
template <Number F>
struct Bracket {
    F s_above = F(0), h_above = F(1);  ///< last sample above; the ray's start if there is none
    F s_below = F(1), h_below = F(0);  ///< first sample at or below; the height tested last
    Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);
    Int<F> steps = Int<F>(0);

    /// Takes in the height h of s in the lanes of `active`; those where it is at or below the
    /// surface.
    Mask<F> narrow(Mask<F> active, F s, F h) {
        const Mask<F> below = active & (h >= F(1) - s), above = active & !below;
        s_below = select(below, s, s_below);
        h_below = select(below, h, h_below);
        s_above = select(above, s, s_above);
        h_above = select(above, h, h_above);
        met_nan = met_nan | (active & is_nan(h));
        count_in<F>(steps, active);
        return below;
    }
};

/// Tests s = min(k / n, 1) for k = 0, 1, ... ceil(n), at most `last`, until one is at or below the
/// surface. n is a lane's own number of steps, at least 1, integral or not. `before`: what of the
/// last sample above is part of the caller's result.
template <Number F, class Height>
Bracket<F> first_bracket(const Height& height, const SearchRay<F>& ray, F n, int last,
                         Before before = Before::needed) {
    Bracket<F> bracket;
    Mask<F> active = ray.active;
    for (const auto k : steps_near_surface<F>(height, ray, active, n, last, before)) {
        const F index = number<F>(k);
        active = active & (index < n + F(1)) & (index <= number<F>(last));
        if (none(active)) break;
        const F s = min(index / n, F(1));
        const F h = height(active, s, ray.at(s), F(1) - s);
        const Mask<F> below = bracket.narrow(active, s, h);
        bracket.found = bracket.found | below;
        bracket.h_below = select(active, h, bracket.h_below);
        active = active & !below;
    }
    return bracket;
}

/// Halves the bracket `times` times, where one was found. `height` as above.
template <Number F, class Height>
void bisect(const Height& height, const SearchRay<F>& ray, int times, Bracket<F>& bracket) {
    for (const auto k : steps<F>(1, times)) {
        const F middle = (bracket.s_above + bracket.s_below) * F(0.5f);
        const F h = height(bracket.found, middle, ray.at(middle), F(1) - middle);
        bracket.narrow(bracket.found, middle, h);
    }
}

/// Where the chord through the two heights of a bracket meets the ray; `weight_above` and
/// `weight_below` scale the gaps at its ends (1 unless a refinement says otherwise). Inside of the
/// bracket; its lower end where a height is NaN, or the one above is infinite.
template <Number F>
F chord(const Bracket<F>& b, F weight_above = F(1), F weight_below = F(1)) {
    const F gap = ((F(1) - b.s_above) - b.h_above) * weight_above;
    const F excess = (b.h_below - (F(1) - b.s_below)) * weight_below;
    const F sum = gap + excess, ratio = gap / sum;
    const F part = select(sum <= F(0), F(0), select(is_nan(ratio), F(1), ratio));
    return min(b.s_above + (b.s_below - b.s_above) * part, b.s_below);
}

/// The lower end of a bracket as a search's result: HIT, FLOOR at s = 1 where nothing was found.
template <Number F>
SearchResult<F> result_of(const Bracket<F>& bracket) {
    SearchResult<F> result;
    result.s = bracket.s_below;
    result.h = bracket.h_below;
    result.status = search_status<F>(bracket.found, bracket.met_nan);
    result.steps = bracket.steps;
    result.fetches = bracket.steps;
    return result;
}

/// The same with s on the chord, whose height is the ray's there.
template <Number F>
SearchResult<F> result_on_chord(const Bracket<F>& bracket) {
    SearchResult<F> result = result_of(bracket);
    const F s = chord(bracket);
    result.s = select(bracket.found, s, result.s);
    result.h = select(bracket.found & (bracket.s_below > F(0)), F(1) - s, result.h);
    return result;
}

}  // namespace quadrel
