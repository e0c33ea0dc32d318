// pom: parallax occlusion mapping: a linear search, then the chord of its last two heights.
//
// Source: N. Tatarchuk, "Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows", I3D
// 2006. Corrects pom-dxsdk: the top plane is tested too, with the height that is there; samples are
// indexed; the test is >=; levels do not fade it out. Steps: trunc(lerp(steps_grazing,
// steps_normal, r)). Exact where the height is linear between the two samples; otherwise the chord
// may be late or early by up to a step. Misses what `linear` misses. No crossing: the bottom plane,
// FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct Pom : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"pom", "trace", "linear search and one chord",
                                    "correction of pom-dxsdk; Tatarchuk 2006"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        std::int32_t steps_grazing = 50, steps_normal = 8;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps_grazing>("steps_grazing", "1", "steps along the surface", 1,
                                          most_steps, 50),
        parameter<&Params::steps_normal>("steps_normal", "1", "steps seen from above", 1,
                                         most_steps, 8)};
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.steps_grazing, params.steps_normal);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const F n =
            steps_by_angle(io.template load<Value::r>(), params.steps_grazing, params.steps_normal);
        const int most = std::max(params.steps_grazing, params.steps_normal);
        store_search(io, ray,
                     result_on_chord(first_bracket(tested_heights(io, heights), ray, n, most)));
    }
};

}  // namespace quadrel
