// shadow-march-thesis: the self-shadow march of the thesis, corrected.
//
// Corrects shadow-march-thesis@published: the ray and the heights are in the same units; the ray
// climbs from the hit to the top plane in steps of 1/n of the relief's depth, with the true shift
// K_L = (depth / L.N) J L; only lights behind the surface (L.N <= 0) are dark outright.
// Hard shadow; misses occluders thinner than |K_L| / n. Without depth nothing shadows.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

struct ShadowMarchThesis : MarchedShadow {
    static constexpr StageText text{"shadow-march-thesis", "shadow",
                                    "linear march from the hit up to the top plane",
                                    "correction of shadow-march-thesis@published"};
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
        const LightRay<F> ray = light_ray(io);
        Mask<F> active = ray.active, occluded(false);
        Int<F> points(0);
        if (when(active)) {
            const auto heights = march_heights(io);
            const auto height = tested_heights(io, heights);
            const F n = number<F>(params.steps);
            const LatticeRays<F> samples = even_steps_up(ray, n);
            const int last = params.steps - 1;
            // Above the top plane, or the highest texel where it is known, nothing occludes.
            const F top(std::min(Scalar<F>(1), height_bounds(io).high));
            for (const auto k : steps_near_surface<F>(height, samples, active, 1, last)) {
                const F t = number<F>(k) / n;
                active = active & (number<F>(k) < n) & (ray.z + t < top);
                if (none(active)) break;
                const F h = height(active, F(1) - (ray.z + t), ray.uv + ray.K * t, ray.z + t);
                count_in<F>(points, active);
                occluded = occluded | (active & (h > ray.z + t));
                active = active & !occluded;
            }
        }
        store_shadow(io, ray, select(occluded, F(0), F(1)), points);
    }
};

}  // namespace quadrel
