// linear: march in n equal steps of depth, first sample at or below the surface wins.
//
// Corrects linear-thesis: the n + 1 tests are at s = k / n over the relief's own depth (the thesis
// marches world units, so that at its default depth 7 of 129 samples can matter), the test is >=,
// and heights are fetched with the gradients of the undisplaced UV.
// May miss features thinner than |K| / n; the s that it returns is at most 1 / n late, never early.
#pragma once

#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

/// First k in [0, n] with height(uv(k/n)) >= 1 - k/n. NaN heights are never at or above the ray.
/// `height(active, s, uv, ray height)` fetches. `start`: steps before it are known to be above the
/// surface.
template <Number F, class Height>
SearchResult<F> linear_march(const Height& height, const SearchRay<F>& ray, int n, int start = 0) {
    SearchResult<F> result;
    const LatticeRays<F> samples = even_steps_down(ray, number<F>(n), n);
    Mask<F> active = ray.active, found(false), met_nan(false);
    for (const auto k : steps_near_surface<F>(height, samples, active, start, n)) {
        active = active & (number<F>(k) <= number<F>(n));
        const F s = number<F>(k) / number<F>(n);
        const F h = height(active, s, ray.at(s), F(1) - s);
        const Mask<F> below = active & (h >= F(1) - s);
        result.s = select(below, s, result.s);
        result.h = select(active, h, result.h);
        count_in<F>(result.steps, active);
        met_nan = met_nan | (active & is_nan(h));
        found = found | below;
        active = active & !below;
        if (none(active)) break;
    }
    result.status = search_status<F>(found, met_nan);
    result.fetches = result.steps;
    return result;
}

/// linear_march over a map whose every height is `h`: its only hit in closed form, without a fetch.
template <Number F>
SearchResult<F> flat_march(const SearchRay<F>& ray, int n, Scalar<F> h) {
    SearchResult<F> result;
    const int k = first_step_below(h, n);
    const Mask<F> found = ray.active & Mask<F>(k <= n);
    result.s = select(found, number<F>(k) / number<F>(n), F(1));
    result.h = select(ray.active, F(h), F(0));
    result.status = search_status<F>(found, Mask<F>(false));
    return result;
}

struct Linear : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"linear", "trace", "linear search in equal steps of depth",
                                    "correction of linear-thesis; McGuire and McGuire 2005"};
    static constexpr auto inputs = search_inputs;
    static constexpr bool uses_height_bounds = true;
    struct Params {
        std::int32_t steps = 128;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, 65536, 128)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const HeightBounds<Scalar<F>> bounds = height_bounds(io);
        if (bounds.flat())
            return store_search(io, ray, flat_march<F>(ray, params.steps, bounds.low));
        const auto heights = march_heights(io);
        const int start = std::min(params.steps, first_step_below(bounds.high, params.steps));
        store_search(io, ray,
                     linear_march<F>(tested_heights(io, heights), ray, params.steps, start));
    }
};

}  // namespace quadrel
