// relief-binary: relief mapping: a linear search, then bisection of its last step.
//
// Source: F. Policarpo, M. M. Oliveira, J. L. D. Comba, "Real-Time Relief Mapping on Arbitrary
// Polygonal Surfaces", I3D 2005; defaults of the demonstration of GPU Gems 3, chapter 18 (15 and
// 6). Corrects relief-gg3: the binary search halves the interval that the linear search found
// instead of walking half steps from its end, and the linear search tests the top and bottom
// planes. Returns the end at or below the surface: at most 2^-binary_steps / steps behind a
// crossing of that interval, which need not be its first. Misses what `linear` misses. No crossing:
// the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ReliefBinary : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"relief-binary", "trace", "linear search, then bisection",
                                    "Policarpo, Oliveira, Comba 2005"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t steps = 15, binary_steps = 6;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, most_steps, 15),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         6)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F n(static_cast<Scalar<F>>(params.steps));
        auto bracket = first_bracket(height, ray, n, params.steps);
        bisect(height, ray, params.binary_steps, bracket);
        store_search(io, ray, result_of(bracket));
    }
};

}  // namespace quadrel
