// secant: a linear search, then the secant method on its last step, kept from leaving it.
//
// Source: E. Risser, M. Shah, S. Pattanaik, "Faster Relief Mapping Using the Secant Method",
// Journal of Graphics Tools 12(3), 2007. Differs: the bracket is kept (regula falsi), so that an
// iteration cannot leave the step, and an end that stays counts half by Illinois' rule (`illinois`
// 0: never, which is the row `interval`). Exact where the height is linear; misses what `linear`
// misses. No crossing: the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/march/regula_falsi.hpp"

namespace quadrel {

struct Secant : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"secant", "trace", "linear search, then regula falsi, Illinois",
                                    "Risser, Shah, Pattanaik 2007; Dowell, Jarratt 1971"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t steps = 15, iterations = 3, illinois = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, most_steps, 15),
        parameter<&Params::iterations>("iterations", "1", "chords that are tested", 0, most_chords,
                                       3),
        choice<&Params::illinois>("illinois", "an end that stays counts half", off_on, 1)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        store_regula_falsi(io, params.steps, params.iterations, params.illinois != 0);
    }
};

}  // namespace quadrel
