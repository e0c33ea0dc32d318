// shadow-soft-riccardi: the deepest point of the light ray under the surface, nearer ones more.
//
// Source: A. Riccardi, "Contact Refinement Parallax Mapping" (github.com/a-riccardi/shader-toy),
// after the soft shadow of sunandblackcat.com's parallax mapping: from the hit to the top plane in
// n equal steps, n the steps of the view march that lie above the hit; visibility is 1 less the
// most of (height over the ray) * (1 - j / n). Corrected: the source walks away from the light and
// takes points above the surface for points below it, and its slope holds for 256 steps only.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

struct ShadowSoftRiccardi : MarchedShadow {
    static constexpr StageText text{"shadow-soft-riccardi", "shadow",
                                    "greatest depth below the surface on the way to the light",
                                    "Riccardi 2018, contact refinement, soft shadow"};
    struct Params {
        std::int32_t steps = 32;
        float hardness = 4;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, 65536, 32),
        parameter<&Params::hardness>("hardness", "1", "factor of the depth below the surface", 0,
                                     1000, 4)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F rise = F(1) - ray.z;
        const F n = round_even(rise * number<F>(params.steps));
        F most(0);
        Int<F> points(0);
        Mask<F> active = ray.active;
        // A sample above the surface takes nothing from `most`.
        const LatticeRays<F> samples = even_steps_up(ray, n, F(0), rise);
        for (const auto j : steps_near_surface<F>(height, samples, active, 1, params.steps - 1)) {
            const F index = number<F>(j);
            active = active & (index < n) & (index < number<F>(params.steps));
            if (none(active)) break;
            const F part = index / n, t = rise * part;
            const F h = height(active, F(1) - (ray.z + t), ray.uv + ray.K * t, ray.z + t);
            count_in<F>(points, active);
            const F depth = (h - (ray.z + t)) * (F(1) - part);
            most = select(active, max(most, depth), most);
        }
        const F visibility = F(1) - clamp(most * F(params.hardness), F(0), F(1));
        store_shadow(io, ray, visibility, points);
    }
};

}  // namespace quadrel
