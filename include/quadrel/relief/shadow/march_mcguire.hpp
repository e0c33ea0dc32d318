// shadow-march-mcguire: steep parallax mapping's self-shadow, corrected.
//
// Source: M. McGuire, M. McGuire, "Steep Parallax Mapping", 2005. Corrects
// shadow-march-mcguire@published: the first tenth of a step moves the coordinate as well as the
// height, steps are indexed, and a march ends on the top plane. From 60 steps for a light at the
// horizon to 5 overhead. Hard; misses occluders thinner than a step.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

struct ShadowMarchMcguire : MarchedShadow {
    static constexpr StageText text{"shadow-march-mcguire", "shadow",
                                    "linear march, more steps for a lower light",
                                    "McGuire and McGuire 2005, Steep Parallax Mapping"};
    struct Params {
        std::int32_t steps_grazing = 60, steps_normal = 5;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps_grazing>(
            "steps_grazing", "1", "steps over the depth, light at the horizon", 1, 65536, 60),
        parameter<&Params::steps_normal>("steps_normal", "1",
                                         "steps over the depth, light overhead", 1, 65536, 5)};
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.steps_grazing, params.steps_normal);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F n = max(trunc(mix(number<F>(params.steps_grazing), number<F>(params.steps_normal),
                                  saturate(ray.r))),
                        F(1));
        const int most = std::max(params.steps_grazing, params.steps_normal);
        Mask<F> active = ray.active, occluded(false);
        Int<F> points(0);
        const LatticeRays<F> samples = even_steps_up(ray, n, F(0.1f));
        for (const auto k : steps_near_surface<F>(height, samples, active, 1, most)) {
            const F t = (number<F>(k) + F(0.1f)) / n;
            active = active & (number<F>(k) <= number<F>(most)) & (ray.z + t < F(1));
            if (none(active)) break;
            const F h = height(active, F(1) - (ray.z + t), ray.uv + ray.K * t, ray.z + t);
            count_in<F>(points, active);
            occluded = occluded | (active & (h >= ray.z + t));
            active = active & !occluded;
        }
        store_shadow(io, ray, select(occluded, F(0), F(1)), points);
    }
};

}  // namespace quadrel
