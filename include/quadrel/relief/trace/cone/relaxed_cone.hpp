// relaxed-cone: steps along cones that the surface may be inside of once, then bisection.
//
// Source: F. Policarpo, M. M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// 2007, chapter 18. Corrects relaxed-cone@published: the number of cone steps is a parameter and a
// ray that has not come down after them says CAP (the published 15 return a point before the
// surface at grazing angles), and the last step is halved, not the whole way down.
// Relaxed cones of the published preprocess are too wide on large maps: its 128 samples per ray
// step over what is thin (relaxed-cone-exact).
#pragma once

#include "quadrel/relief/trace/cone/cone_walk.hpp"

namespace quadrel {

/// Parameters of the relaxed cone searches.
struct RelaxedConeParams {
    std::int32_t steps = 64, binary_steps = 8;
};
inline constexpr std::array relaxed_cone_parameters{
    parameter<&RelaxedConeParams::steps>("steps", "1", "cone steps at most", 1, 65536, 64),
    parameter<&RelaxedConeParams::binary_steps>("binary_steps", "1", "halvings of the last step", 0,
                                                60, 8)};

struct RelaxedCone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"relaxed-cone", "trace",
                                    "steps along relaxed cones, then bisection",
                                    "Policarpo and Oliveira 2007, GPU Gems 3, chapter 18"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::relaxed_cone);
    using Params = RelaxedConeParams;
    static constexpr auto parameters = relaxed_cone_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto look = cone_look_up<TextureSlot::relaxed_cone>(io);
        auto walk = walk_cones<F>(ray, look, fall_by_cone(ray), params.steps, F(1.0f / 4096));
        bisect_last_step<F>(ray, look, params.binary_steps, walk);
        store_search(io, ray, walk.result);
    }
};

}  // namespace quadrel
