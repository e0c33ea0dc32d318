// thesis-sphere: steps along the ray as long as the surface is below it.
//
// Source: "Derivative-Based Relief Mapping" (2012), which describes, draws and times a
// "sphere-based" search that steps by "the distance between the ray and the height map", measured
// straight down, at every sample. It has no listing. (It is not the distance field of Donnelly,
// GPU Gems 2, chapter 8, to which it refers: a vertical distance bounds nothing to the side.)
//     s += ((1 - s) - h) r,   r = N.V: a step of that length along the ray.
// A hit is within `tolerance` heights above the surface, or below it: steps shrink towards the
// surface and never reach it. Misses whatever is thinner than a step. A ray straight down hits at
// its second sample. After `steps` samples above the surface: CAP, where it is.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ThesisSphere : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"thesis-sphere", "trace",
                                    "steps by the vertical distance to the surface",
                                    "Derivative-Based Relief Mapping (2012)"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        std::int32_t steps = 64;
        float tolerance = 1.0f / 1024;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "samples at most", 1, most_steps, 64),
        parameter<&Params::tolerance>("tolerance", "relief depths", "gap that counts as a hit", 0,
                                      1, 1.0 / 1024)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        // Frames of listings may say that the ray comes from below, or NaN: it does not climb.
        const F r = max(F(0), io.template load<Value::r>()), tolerance(params.tolerance);
        SearchResult<F> result;
        result.s = F(0);
        Mask<F> active = ray.active, met_nan(false);
        for (const auto k : steps<F>(1, params.steps)) {
            const vec2<F> at = ray.at(result.s);
            const F h = heights(active, at), gap = (F(1) - result.s) - h;
            io.march_step(active, result.s, at, F(1) - result.s, h);
            result.h = select(active, h, result.h);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(h));
            active = active & (gap > tolerance);
            if (none(active)) break;
            result.s = select(active, min(result.s + gap * r, F(1)), result.s);
        }
        result.status = search_status<F>(ray.active & !active, met_nan, Status::cap);
        result.fetches = result.steps;
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
