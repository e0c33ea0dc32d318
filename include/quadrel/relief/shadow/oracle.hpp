// shadow-oracle: whether any point of the height field lies above the ray to the light.
//
// No source's: the judge of shadows, with no bias. The ray starts on the surface itself at the UV
// of the hit, wherever the search for the hit stopped; on blocks at the hit, so that a wall sees no
// light from behind. Dark where the field is above the ray beyond what double rounds; a ray that
// only touches is lit, and so is one that would cross more than 2^31 cells or 2^20 nodes. Level 0,
// whatever filters the sampler has; its wrap modes hold. shadow.steps counts nodes and cells.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/oracle/lanes.hpp"

namespace quadrel {

struct ShadowOracle : StageDefaults {
    static constexpr StageText text{"shadow-oracle", "shadow",
                                    "whether the height field is above the ray to the light", "-"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    struct Params {
        std::int32_t surface = 0;
    };
    static constexpr std::array parameters{oracle::surface_parameter<&Params::surface>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> light = light_ray(io);
        const F s = io.template load<Value::hit_s>();
        const oracle::Field field =
            oracle::field_of(io, static_cast<oracle::Surface>(params.surface));
        F visible(1);
        Int<F> steps(0);
        for (int lane = 0; lane < 4; ++lane) {
            const oracle::RayUp ray{light.uv.x.lane[lane], light.uv.y.lane[lane],
                                    light.K.x.lane[lane], light.K.y.lane[lane],
                                    1 - static_cast<double>(s.lane[lane])};
            if (light.active.lane[lane] && is_occluded(field, ray, steps.lane[lane]))
                visible.lane[lane] = 0;
        }
        store_shadow(io, light, visible, steps);
    }
};

}  // namespace quadrel
