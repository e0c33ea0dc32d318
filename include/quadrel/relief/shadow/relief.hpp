// shadow-relief: the view's search, run from the light.
//
// Source: F. Policarpo, M. M. Oliveira, J. L. D. Comba, "Real-Time Relief Mapping on Arbitrary
// Polygonal Surfaces", I3D 2005: the ray that enters the top plane towards the hit is searched as
// the view's is, in equal steps and by bisection; the hit is in shadow where it meets the surface
// earlier, by more than `bias`. The same cost and misses as relief-binary.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

struct ShadowRelief : MarchedShadow {
    static constexpr StageText text{"shadow-relief", "shadow",
                                    "linear search and bisection from the light's side",
                                    "Policarpo, Oliveira, Comba 2005"};
    struct Params {
        std::int32_t steps = 15, binary_steps = 6;
        float bias = 0.02f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps from the top plane to the hit", 1, 65536,
                                  15),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         6),
        parameter<&Params::bias>("bias", "depth", "how much earlier an occluder is met", 0, 1,
                                 0.02)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        Int<F> points(0);
        // t falls from the top plane, 1 - z, to the hit, 0.
        const F top = F(1) - ray.z;
        const auto below = [&](Mask<F> active, F t) {
            const F h = height(active, F(1) - (ray.z + t), ray.uv + ray.K * t, ray.z + t);
            count_in<F>(points, active);
            return active & (h >= ray.z + t);
        };
        F last_above = top, first_below(0);
        Mask<F> active = ray.active, found(false);
        const F n = number<F>(params.steps);
        for (const auto k : steps_near_surface<F>(height, even_steps_back(ray, top, n), active, 0,
                                                  params.steps - 1, Before::needed)) {
            active = active & (number<F>(k) < n);
            const F t = top * (F(1) - number<F>(k) / n);
            const Mask<F> hit = below(active, t);
            first_below = select(hit, t, first_below);
            last_above = select(active & !hit, t, last_above);
            found = found | hit;
            active = active & !hit;
            if (none(active)) break;
        }
        for (const auto k : steps<F>(1, params.binary_steps)) {
            if (none(found)) break;
            const F middle = (last_above + first_below) * F(0.5f);
            const Mask<F> hit = below(found, middle);
            first_below = select(hit, middle, first_below);
            last_above = select(found & !hit, middle, last_above);
        }
        const Mask<F> occluded = found & (first_below > F(params.bias));
        store_shadow(io, ray, select(occluded, F(0), F(1)), points);
    }
};

}  // namespace quadrel
