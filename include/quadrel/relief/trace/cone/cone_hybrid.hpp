// cone-hybrid: cones between the conservative and the relaxed one, then bisection.
//
// After "Per-Pixel Displacement Mapping Using Hybrid Cone Approach", of which only the abstract
// could be read: cones between the conservative and the relaxed cone of a texel. How the paper
// mixes them is not known here; this row takes the linear mixture by `weight`, 0 conservative, 1
// relaxed, and is inspired by the idea, not a reproduction.
#pragma once

#include "quadrel/relief/trace/cone/cone_walk.hpp"

namespace quadrel {

struct ConeHybrid : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"cone-hybrid", "trace",
                                    "cones between conservative and relaxed, then bisection",
                                    "inspired by \"hybrid cone approach\" (abstract)"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::cone, TextureSlot::relaxed_cone_exact);
    struct Params {
        std::int32_t steps = 128, binary_steps = 8;
        float weight = 0.5f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "cone steps at most", 1, 65536, 128),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         8),
        parameter<&Params::weight>("weight", "1", "share of the relaxed cone", 0, 1, 0.5)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto conservative = cone_look_up<TextureSlot::cone>(io);
        const BakedLookUp<TextureSlot::relaxed_cone_exact, 2, Io> relaxed(io);
        const auto look = [&](Mask<F> active, F s, const vec2<F>& uv) {
            const Cone<F> narrow = conservative(active, s, uv);
            const F wide = relaxed(active, uv).channel[1];
            return Cone<F>{narrow.height, lerp(narrow.ratio, wide, F(params.weight))};
        };
        auto walk = walk_cones<F>(ray, look, fall_by_cone(ray), params.steps, F(1.0f / 4096));
        bisect_last_step<F>(ray, look, params.binary_steps, walk);
        walk.result.fetches = walk.result.fetches * Int<F>(2);
        store_search(io, ray, walk.result);
    }
};

}  // namespace quadrel
