// interval: interval mapping: a linear search, then plain regula falsi on its last step.
//
// Source: E. Risser, M. Shah, S. Pattanaik, "Interval Mapping", University of Central Florida,
// 2005: the interval between a point above and a point below the surface is cut where the chord of
// their heights meets the ray. Nothing is changed; `secant` is faster where the surface is curved.
// After the iterations the last chord is the result, untested. Exact where the height is linear;
// misses what `linear` misses. No crossing: the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/march/regula_falsi.hpp"

namespace quadrel {

struct Interval : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"interval", "trace", "linear search, then regula falsi",
                                    "Risser, Shah, Pattanaik 2005"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t steps = 15, iterations = 3;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, most_steps, 15),
        parameter<&Params::iterations>("iterations", "1", "chords that are tested", 0, most_chords,
                                       3)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        store_regula_falsi(io, params.steps, params.iterations, false);
    }
};

}  // namespace quadrel
