// Regula falsi on a bracket: the ray is met with the chord of the two heights, and the height there
// replaces the end on its side of the surface.
#pragma once

#include <limits>

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// Chords that rows may ask for. A float's bits are settled long before.
inline constexpr std::int32_t most_chords = 64;

/// Chords as they come. Of numbers with derivatives one that ends where the last one did moves as
/// that: once a root's bits are settled, an end that counts less and less leaves the point where it
/// is and would multiply its derivatives each time, until they overflow.
template <Number F>
struct ChordMotion {
    F operator()(const F& s) { return s; }
};
template <Number F>
requires requires(typename NumberTraits<F>::Element x) { x.dx; }
struct ChordMotion<F> {
    F last = F(std::numeric_limits<Scalar<F>>::quiet_NaN());
    F operator()(const F& s) { return last = select(s == last, last, s); }
};

/// `times` chords, where the bracket was found. `illinois`: an end that stays twice in a row counts
/// half, and half again each further time (M. Dowell, P. Jarratt, BIT 11, 1971), without which
/// convex surfaces are approached from one side alone.
template <Number F, class Height>
void regula_falsi(const Height& height, const SearchRay<F>& ray, int times, bool illinois,
                  Bracket<F>& bracket) {
    F weight_above(1), weight_below(1);
    F replaced(0);  // 1: the lower end was last, -1: the upper one
    ChordMotion<F> motion;
    for (const auto k : steps<F>(1, times)) {
        const F s = motion(chord(bracket, weight_above, weight_below));
        const F h = height(bracket.found, s, ray.at(s), F(1) - s);
        const Mask<F> below = bracket.narrow(bracket.found, s, h);
        if (illinois) {
            const F side = select(below, F(1), F(-1));
            const F stayed = select(side == replaced, F(0.5f), F(1));
            weight_above = select(below, weight_above * stayed, F(1));
            weight_below = select(below, F(1), weight_below * stayed);
            replaced = side;
        }
    }
}

/// Marches, refines and stores the last chord, which is not tested any more.
template <class Io>
void store_regula_falsi(Io& io, int steps, int iterations, bool illinois) {
    using F = typename Io::Number;
    const SearchRay<F> ray = search_ray(io);
    const auto heights = march_heights(io);
    const auto height = tested_heights(io, heights);
    const F n(static_cast<Scalar<F>>(steps));
    auto bracket = first_bracket(height, ray, n, steps);
    regula_falsi(height, ray, iterations, illinois, bracket);
    store_search(io, ray, result_on_chord(bracket));
}

}  // namespace quadrel
