// shade-welsh@published: the lighting of the paper's fragment program, as published.
//
// Source: T. Welsh, "Parallax Mapping with Offset Limiting" (2004), appendix, from "normalize the
// light0 vector" on. Two lights (a light that the scene lacks is black), state.light[n].diffuse
// their diffuse colours, state.lightmodel.ambient the first light's ambient colour; MUL_SAT and
// ADD_SAT saturate each. Neither distance nor shadows nor the material's colours count. Ambient
// occlusion, which the program has none of, multiplies the ambient colour: 1 unless chosen. The
// vectors are in eye space instead of tangent space; N is what the chosen surface stage made.
#pragma once

#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeWelshPublished : StageDefaults {
    static constexpr StageText text{"shade-welsh@published", "shade", "two saturating matte lights",
                                    "Welsh, Parallax Mapping with Offset Limiting (2004)"};
    static constexpr auto inputs =
        values(Value::dUVdx, Value::dUVdy, Value::hit_P, Value::hit_uv, Value::N, Value::occlusion);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const bool any_light = io.frame().light_count > 0;
        const vec3<F> ambient =
            any_light ? uniform3<F>(io.frame().lights[0].ambient) : vec3<F>(F(0));
        vec3<F> total = one_light<F>(io, 0);
        total = saturate(total + one_light<F>(io, 1));
        total = saturate(total + ambient * io.template load<Value::occlusion>());
        io.template store<Value::color>(saturate(rgb(rgba) * total));
        io.template store<Value::opacity>(rgba.w);
    }

  private:
    /// MUL_SAT of light i's colour by its cosine.
    template <class F, class Io>
    static vec3<F> one_light(Io& io, int i) {
        if (i >= io.frame().light_count) return vec3<F>(F(0));
        const LightUniforms& light = io.frame().lights[i];
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), light);
        return saturate(uniform3<F>(light.diffuse) * dot(io.template load<Value::N>(), L));
    }
};

}  // namespace quadrel
