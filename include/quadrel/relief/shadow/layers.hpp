// shadow-layers: a march from the hit towards the light through depth layers.
//
// Source: F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D
// 2006: the light's ray goes through the layers as the view's does; dark where a sample is inside
// of a solid. Differs: from the hit upwards, in equal steps of the relief's depth, as
// shadow-march-thesis, so that no bias is needed but the first step. Hard; misses solids thinner
// than |K_L| / steps; lights behind the surface are dark outright.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/layer/march_layers.hpp"

namespace quadrel {

struct ShadowLayers : MarchedShadow {
    static constexpr StageText text{"shadow-layers", "shadow",
                                    "linear march from the hit up through depth layers",
                                    "Policarpo and Oliveira 2006"};
    static constexpr auto textures = slots(TextureSlot::layers);
    struct Params {
        std::int32_t steps = 128;
    };
    static constexpr std::array parameters{parameter<&Params::steps>(
        "steps", "1", "steps over the relief's depth", 1, most_steps, 128)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const MarchLayers<Io, 4> depths(io);
        const F n = number<F>(params.steps);
        Mask<F> active = ray.active, occluded(false);
        Int<F> points(0);
        for (const auto k : steps<F>(1, params.steps - 1)) {
            const F t = number<F>(k) / n;
            const F s = F(1) - (ray.z + t);
            active = active & (s > F(0));
            if (none(active)) break;
            const vec4<F> found = depths(active, s, ray.uv + ray.K * t);
            count_in<F>(points, active);
            occluded = occluded | (active & is_inside<4>(found, s));
            active = active & !occluded;
        }
        store_shadow(io, ray, select(occluded, F(0), F(1)), points);
    }
};

}  // namespace quadrel
