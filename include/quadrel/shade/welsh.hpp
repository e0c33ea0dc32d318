// shade-welsh: matte light with saturating arithmetic, as fixed-function hardware had it.
//
// Generalises shade-welsh@published, in its order of saturations: every light in turn, its colour,
// intensity, attenuation and shadow; material colours; ambient light of all lights.
//     total = 0;  per light: total = sat(total + sat(N.L Ld Md a));  total = sat(total + ambient)
//     color = sat(base total)
// a = visibility I / (c + l d + q d^2). What is brighter than 1 is cut off light by light, so that
// hues shift. No emission, no highlight.
#pragma once

#include "quadrel/shade/lights.hpp"

namespace quadrel {

struct ShadeWelsh : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-welsh", "shade", "saturating matte lighting",
                                    "generalisation of shade-welsh@published"};
    static constexpr auto inputs = lit_inputs;
    static constexpr auto outputs =
        values(Value::light_ambient, Value::light_diffuse, Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);
    using Params = MapParams;
    static constexpr auto parameters = map_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec4<F> base = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)), params.gradients);
        const vec3<F> N = io.template load<Value::N>(), P = io.template load<Value::hit_P>();
        const auto& material = io.material();
        vec3<F> total(F(0)), ambient(F(0));
        for (int i = 0; i < io.frame().light_count; ++i) {
            const auto& light = io.frame().lights[i];
            const F arriving =
                io.template load<Value::shadow_visibility>(i) * attenuation(P, light);
            const vec3<F> color =
                uniform3<F>(light.diffuse) * uniform3<F>(material.diffuse) * arriving;
            const vec3<F> lit = saturate(color * dot(N, to_light(P, light)));
            total = i == 0 ? lit : saturate(total + lit);
            ambient = light_sum(i == 0, ambient,
                                uniform3<F>(light.ambient) * uniform3<F>(material.ambient));
        }
        ambient = ambient * io.template load<Value::occlusion>();
        io.template store<Value::light_ambient>(ambient * rgb(base));
        io.template store<Value::light_diffuse>(total * rgb(base));
        io.template store<Value::color>(saturate(rgb(base) * saturate(total + ambient)));
        io.template store<Value::opacity>(base.w);
    }
};

}  // namespace quadrel
