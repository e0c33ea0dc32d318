// steep-constant-xy: linear search in steps of a given length in the plane.
//
// Corrects steep-constant-xy@published (McGuire and McGuire 2005, the lines that their listing
// keeps as a comment, and their remark that one "should be marching in texels"): the height of a
// step follows from its length and the ray's slope, and the steps end exactly at the bottom plane.
// n = ceil(|K| / uv_step), at least `min_steps` (a ray straight down has no length in the plane)
// and at most `max_steps`; samples at k / n, k = 0 included. The first at or below the surface
// wins; else FLOOR. At most uv_step late in the plane, or 1 / n of the depth; never early.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct SteepConstantXy : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "steep-constant-xy", "trace", "linear search in steps of constant UV length",
        "correction of steep-constant-xy@published; McGuire and McGuire 2005"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        float uv_step = 1.0f / 128;
        std::int32_t min_steps = 5, max_steps = 1024;
    };
    static constexpr std::array parameters{
        parameter<&Params::uv_step>("uv_step", "UV", "length of a step", 0x1p-20, 16, 1.0 / 128),
        parameter<&Params::min_steps>("min_steps", "1", "least number of steps", 1, most_steps, 5),
        parameter<&Params::max_steps>("max_steps", "1", "greatest number of steps", 1, most_steps,
                                      1024)};
    static std::int32_t lattice_steps(const Params& params) { return params.max_steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const F most(static_cast<Scalar<F>>(params.max_steps));
        const F n = clamp(ceil(length(ray.K) / F(params.uv_step)),
                          F(static_cast<Scalar<F>>(params.min_steps)), most);
        store_search(io, ray,
                     result_of(first_bracket(tested_heights(io, heights), ray, n, params.max_steps,
                                             Before::not_needed)));
    }
};

}  // namespace quadrel
