// shadow-cone: the light ray in steps along the cones of a cone map.
//
// After J. Dummer, "Cone Step Mapping", 2006, whose cones hold for rays that climb as well: above a
// point of the surface with gap g a ray that moves sideways by |K| a unit of height leaves the cone
// of ratio c after rising by c g / (|K| - c), and never if c >= |K|: lit at once. Starts `bias`
// above the hit. Conservative as far as the cones are: lit where nothing is met, dark where the ray
// is at or below the surface; a ray that is still on its way after all steps is lit.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

struct ShadowCone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-cone", "shadow", "steps along the cones of a cone map",
                                    "after Dummer 2006, Cone Step Mapping"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::cone_robust);
    struct Params {
        std::int32_t steps = 128;
        float bias = 1.0f / 256;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps at most", 1, 65536, 128),
        parameter<&Params::bias>("bias", "depth",
                                 "height over the hit where the ray starts, and "
                                 "the least step",
                                 1e-6, 1, 1.0 / 256)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto look = cone_look_up<TextureSlot::cone_robust>(io);
        const F kappa = length(ray.K), least(params.bias);
        Mask<F> active = ray.active, occluded(false);
        Int<F> points(0);
        F t = least;
        for (const auto k : steps<F>(1, params.steps)) {
            active = active & (ray.z + t < F(1));
            if (none(active)) break;
            const Cone<F> cone = look(active, F(1) - (ray.z + t), ray.uv + ray.K * t);
            count_in<F>(points, active);
            const F gap = (ray.z + t) - cone.height;
            occluded = occluded | (active & (gap < F(0)));
            active = active & (gap >= F(0)) & (cone.ratio < kappa);
            t = select(active, t + max(cone.ratio * gap / (kappa - cone.ratio), least), t);
        }
        store_shadow(io, ray, select(occluded, F(0), F(1)), points);
    }
};

}  // namespace quadrel
