// shadow-soft-pom@published: the soft self-shadow of the DirectX SDK's parallax occlusion mapping.
//
// Source: N. Tatarchuk, "Practical Parallax Occlusion Mapping", 2006; DirectX SDK (2006 to 2010),
// ParallaxOcclusionMapping.fx: seven samples towards the light at fixed fractions of an offset that
// is L.xy times the height scale, each excess of height weighted by how near the occluder is. Kept:
// the offset is not divided by L.z; nothing is clamped, so that where every sample is lower than
// the ray the light is more than full before it is mapped to 0.4 to 1.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

/// Fractions of the offset, and the weights of what is found there.
inline constexpr float soft_pom_at[7] = {0.88f, 0.77f, 0.66f, 0.55f, 0.44f, 0.33f, 0.22f};
inline constexpr float soft_pom_weight[7] = {1, 2, 4, 6, 8, 10, 12};

/// The largest weighted excess of height over a ray that rises by 1 over `offset`.
template <class Io, class Heights, class F = typename Io::Number>
F soft_pom_excess(const Io& io, const Heights& height, Mask<F> active, const vec2<F>& uv,
                  const vec2<F>& offset, F softening) {
    const F start = height(active, uv);
    F most(0);
    for (int k = 0; k < 7; ++k) {
        const F at(soft_pom_at[k]);
        const vec2<F> there = uv + offset * at;
        const F h = height(active, there);
        io.march_step(active, F(1) - (start + at), there, start + at, h);
        const F excess = (h - start - at) * F(soft_pom_weight[k]) * softening;
        most = k == 0 ? excess : max(most, excess);
    }
    return most;
}

struct ShadowSoftPomPublished : StageDefaults {
    static constexpr StageText text{"shadow-soft-pom@published", "shadow",
                                    "seven samples towards the light, softened, as listed",
                                    "Tatarchuk 2006; DirectX SDK, ParallaxOcclusionMapping.fx"};
    static constexpr auto inputs = light_ray_inputs_and(Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    struct Params {
        float softening = 0.58f;
    };
    static constexpr std::array parameters{parameter<&Params::softening>(
        "softening", "1", "factor of every sample's excess", 0, 10, 0.58)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const auto height = march_heights(io);
        const F most =
            soft_pom_excess(io, height, ray.active, ray.uv, ray.K * ray.r, F(params.softening));
        const F visibility = (F(1) - most) * F(0.6f) + F(0.4f);
        store_shadow(io, ray, select(ray.active, visibility, F(1)),
                     select(ray.active, Int<F>(8), Int<F>(0)));
    }
};

}  // namespace quadrel
