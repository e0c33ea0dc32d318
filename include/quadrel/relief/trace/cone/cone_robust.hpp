// cone-robust: cone steps that are never shorter than to the next border between texel centres.
//
// Source: R. Ban, G. Valasek, C. Balint, V. Vad, "Robust Cone Step Mapping", EGSR 2024: cones are
// the least of 3x3 texels, so that interpolating them is safe, and a step that a cone would end
// inside of a bilinear patch goes on to the patch's border. Its last step is halved here, where the
// source offers no, one linear or several binary refinements.
// Late where a ray enters and leaves the surface between two borders (a spike, a saddle), and by
// the last halving.
#pragma once

#include "quadrel/relief/trace/cone/cone_walk.hpp"

namespace quadrel {

struct ConeRobust : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"cone-robust", "trace",
                                    "cone steps, at least to the next patch of the surface",
                                    "Ban, Valasek, Balint, Vad 2024"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::cone_robust);
    struct Params {
        std::int32_t steps = 512, binary_steps = 8;
        float relax = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "points of the ray that may be tested", 1, 65536,
                                  512),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         8),
        parameter<&Params::relax>("relax", "1", "factor of every step", 0.01, 2, 1)};
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec2<F> size = TexelSize<F>(height_map(io)).texels;
        const auto look = cone_look_up<TextureSlot::cone_robust>(io);
        auto walk = walk_cones<F>(ray, look, fall_from_patch_to_patch(ray, size, F(params.relax)),
                                  params.steps, F(rounding_gap<F>));
        bisect_last_step<F>(ray, look, params.binary_steps, walk);
        store_search(io, ray, walk.result);
    }
};

}  // namespace quadrel
