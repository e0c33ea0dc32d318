// steep: steep parallax mapping, more steps at grazing angles.
//
// Corrects steep@published (McGuire and McGuire 2005): a whole number of steps, ceil of lerp(2 n,
// n, r), so that the last sample is the bottom plane and none is below it; samples at k / n are
// indexed, not accumulated; the shift is along the frame's K; heights are fetched with the
// gradients of the undisplaced UV. Tests k = 0, misses what is thinner than |K| / n, is at most one
// step late and never early. No crossing: the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct Steep : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"steep", "trace", "linear search, twice the steps when grazing",
                                    "correction of steep@published; McGuire and McGuire 2005"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        std::int32_t steps = 5;
    };
    static constexpr std::array parameters{parameter<&Params::steps>(
        "steps", "1", "steps seen from above; twice as many along the surface", 1, 32768, 5)};
    static std::int32_t lattice_steps(const Params& params) { return 2 * params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const F n = steps_by_angle(io.template load<Value::r>(), 2 * params.steps, params.steps,
                                   StepRounding::up);
        store_search(io, ray,
                     result_of(first_bracket(tested_heights(io, heights), ray, n, 2 * params.steps,
                                             Before::not_needed)));
    }
};

}  // namespace quadrel
