// shadow-march-mcguire@published: steep parallax mapping's self-shadow, as listed.
//
// Source: M. McGuire, M. McGuire, "Steep Parallax Mapping", 2005, fragment shader. The listing's
// delta is K / numShadowSteps, its height starts from the texel that the view search ended on.
// Kept: the height starts a tenth of a step up, the coordinate does not; heights are accumulated;
// the number of steps is cut to an integer; the last test may lie above the top plane. Visible
// where the march left the field. texture2D in the loop takes implicit derivatives.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"

namespace quadrel {

struct ShadowMarchMcguirePublished : StageDefaults {
    static constexpr StageText text{"shadow-march-mcguire@published", "shadow",
                                    "linear march, 60 to 5 steps, as listed",
                                    "McGuire and McGuire 2005, Steep Parallax Mapping"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const F steps_of_lane = trunc(mix(F(60), F(5), ray.r));
        const F step = F(1) / steps_of_lane;
        const vec2<F> delta = ray.K / steps_of_lane;
        F sampled = io.template load<Value::hit_h>();
        F height = sampled + step * F(0.1f);
        vec2<F> at = ray.uv;
        Int<F> steps(0);
        Mask<F> active = ray.active;
        for (int k = 0; k <= 61; ++k) {
            active = active & (sampled < height) & (height < F(1));
            if (!any(active)) break;
            height = select(active, height + step, height);
            at = select(active, at + delta, at);
            const F h = texture(map, io.template context<TextureSlot::height>(active), at,
                                io.frame().derivatives)
                            .x;
            io.march_step(active, F(1) - height, at, height, h);
            sampled = select(active, h, sampled);
            count_in<F>(steps, active);
        }
        const Mask<F> escaped = (sampled < height) | !ray.active;
        store_shadow(io, ray, select(escaped, F(1), F(0)), steps);
    }
};

}  // namespace quadrel
