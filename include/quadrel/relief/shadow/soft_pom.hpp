// shadow-soft-pom: the soft self-shadow of parallax occlusion mapping, corrected.
//
// Source: N. Tatarchuk, "Practical Parallax Occlusion Mapping", 2006. Corrects
// shadow-soft-pom@published: the samples lie on the true light ray, so that a low light reaches far
// enough, and the weighted excess of height is clamped to [0, 1]; visibility runs from 0 to 1.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/shadow/soft_pom_published.hpp"

namespace quadrel {

struct ShadowSoftPom : MarchedShadow {
    static constexpr StageText text{"shadow-soft-pom", "shadow",
                                    "seven samples on the light ray, softened",
                                    "correction of shadow-soft-pom@published"};
    using Params = ShadowSoftPomPublished::Params;
    static constexpr auto parameters = ShadowSoftPomPublished::parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto height = march_heights(io);
        const F most = soft_pom_excess(io, height, ray.active, ray.uv, ray.K, F(params.softening));
        const F visibility = F(1) - clamp(most, F(0), F(1));
        store_shadow(io, ray, select(ray.active, visibility, F(1)),
                     select(ray.active, Int<F>(8), Int<F>(0)));
    }
};

}  // namespace quadrel
