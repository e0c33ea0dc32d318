// shade-welsh@published: the lighting of the paper's fragment program, as published.
//
// Source: T. Welsh, "Parallax Mapping with Offset Limiting" (2004), appendix, from "normalize the
// light0 vector" on. Two lights (a light that the scene lacks is black), state.light[n].diffuse
// their diffuse colours, state.lightmodel.ambient the first light's ambient colour; MUL_SAT and
// ADD_SAT saturate each. Neither distance nor shadows nor the material's colours count. The light
// vectors are those of the vertex program, interpolated (tangent_light.hpp); the normal is what the
// chosen surface stage made, normal-welsh@published as the program does. Kept: a directional light
// is taken for a point where its direction ends, in the object's space; a back face is lit as the
// front. The colour's look-up takes the implicit derivatives of the displaced coordinate. Ambient
// occlusion, which the program has none of, multiplies the ambient colour: 1 unless chosen.
// Not reproduced: the colour's fourth component, since A is coverage.
#pragma once

#include "quadrel/relief/tangent_light.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeWelshPublished : TangentShade {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-welsh@published", "shade", "two saturating matte lights",
                                    "Welsh, Parallax Mapping with Offset Limiting (2004)"};
    static constexpr const char* not_reproduced = "the colour's fourth component: A is coverage";
    static constexpr auto inputs =
        values_and(tangent_light_inputs, Value::hit_uv, Value::occlusion);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = listed_map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const bool any_light = io.frame().light_count > 0;
        const vec3<F> ambient =
            any_light ? uniform3<F>(io.frame().lights[0].ambient) : vec3<F>(F(0));
        const TangentLight light(io);
        vec3<F> total = one_light<F>(io, light, 0);
        total = saturate(total + one_light<F>(io, light, 1));
        total = saturate(total + ambient * io.template load<Value::occlusion>());
        io.template store<Value::color>(saturate(rgb(rgba) * total));
        io.template store<Value::opacity>(rgba.w);
    }

  private:
    /// MUL_SAT of light i's colour by its cosine.
    template <class F, class Io>
    static vec3<F> one_light(Io& io, const TangentLight<Io>& light, int i) {
        if (i >= io.frame().light_count) return vec3<F>(F(0));
        const auto& uniforms = io.frame().lights[i];
        const vec3<F> lighttsvec = normalize(light.to_point(uniforms));
        return saturate(uniform3<F>(uniforms.diffuse) * dot(light.normal(), lighttsvec));
    }
};

}  // namespace quadrel
