// relaxed-cone-exact: relaxed cones of falling edges, steps from patch to patch, then bisection.
//
// Source: R. Ban, G. Valasek, C. Balint, V. Vad, "Robust Cone Step Mapping", EGSR 2024: only edges
// of the surface that fall away from a texel limit its relaxed cone, and a step goes at least to
// the next border between texel centres. Corrects relaxed-cone, whose cones come from samples.
#pragma once

#include "quadrel/relief/trace/cone/relaxed_cone.hpp"

namespace quadrel {

struct RelaxedConeExact : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"relaxed-cone-exact", "trace",
                                    "relaxed cones of falling edges, steps between patches",
                                    "Ban, Valasek, Balint, Vad 2024"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::relaxed_cone_exact);
    struct Params {
        std::int32_t steps = 512, binary_steps = 12;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "cone steps at most", 1, 65536, 512),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         12)};
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec2<F> size = TexelSize<F>(height_map(io)).texels;
        const auto look = cone_look_up<TextureSlot::relaxed_cone_exact>(io);
        auto walk = walk_cones<F>(ray, look, fall_from_patch_to_patch(ray, size), params.steps,
                                  F(rounding_gap<F>));
        bisect_last_step<F>(ray, look, params.binary_steps, walk);
        store_search(io, ray, walk.result);
    }
};

}  // namespace quadrel
