// contact: contact refinement: a linear search, then a second one inside of its last step.
//
// Source: A. Riccardi, "Contact Refinement Parallax Mapping" (a-riccardi/shader-toy), 2018; also
// O3DE, ParallaxMapping.azsli. Differs: both marches are indexed, so that the fine samples lie
// inside of the coarse step (the source adds up, keeps the depth of the coarse hit, and its slope
// depends on the number of layers); the end of the coarse step is known and not fetched again. With
// `interpolate` on the chord of the last two heights is the result, as in the source, else the
// first fine sample at or below the surface: at most 1 / (steps fine_steps) late, never early. Sees
// the first crossing inside of the step better than a bisection; misses what `linear` misses. No
// crossing: the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct Contact : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"contact", "trace", "linear search, then a finer one",
                                    "Riccardi 2018"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t steps = 16, fine_steps = 16, interpolate = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, most_steps, 16),
        parameter<&Params::fine_steps>("fine_steps", "1", "steps within the last of those", 1,
                                       most_steps, 16),
        choice<&Params::interpolate>("interpolate", "the chord of the last heights", off_on, 0)};
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.steps, params.fine_steps);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F n(static_cast<Scalar<F>>(params.steps));
        auto bracket = first_bracket(height, ray, n, params.steps);
        const bool on_chord = params.interpolate != 0;
        refine(height, ray, params.fine_steps, on_chord ? Before::needed : Before::not_needed,
               bracket);
        store_search(io, ray, on_chord ? result_on_chord(bracket) : result_of(bracket));
    }

  private:
    /// The samples between the ends of the brackets, whose last one is part of a chord.
    template <class F>
    static LatticeRays<F> fine_samples(const SearchRay<F>& ray, const Bracket<F>& bracket, int n,
                                       Before before) {
        const F part = (bracket.s_below - bracket.s_above) / number<F>(n);
        const F last = before == Before::needed ? number<F>(n - 1)
                                                : F(std::numeric_limits<Scalar<F>>::infinity());
        return {ray.at(bracket.s_above), ray.K * part, F(1) - bracket.s_above, -part, ray.K, last};
    }

    template <class Height, class F>
    static void refine(const Height& height, const SearchRay<F>& ray, int n, Before before,
                       Bracket<F>& bracket) {
        const F start = bracket.s_above, length = bracket.s_below - bracket.s_above;
        const LatticeRays<F> samples = fine_samples(ray, bracket, n, before);
        Mask<F> active = bracket.found & (length > F(0));
        for (const auto k : steps_near_surface<F>(height, samples, active, 1, n - 1, before)) {
            active = active & (number<F>(k) <= number<F>(n - 1));
            if (none(active)) break;
            const F part = number<F>(k) / number<F>(n);
            const F s = start + length * part;
            const F h = height(active, s, ray.at(s), F(1) - s);
            active = active & !bracket.narrow(active, s, h);
        }
    }
};

}  // namespace quadrel
