// shade-thesis: the lighting of the thesis, corrected.
//
// Corrects shade-thesis@published: every declared uniform takes effect (light and material colours,
// intensity, attenuation by distance, any number of lights), diffuse and specular are clamped and
// stay on the lit side, the environment keeps still when the camera turns, total internal
// reflection shows the reflection. Maps are ordinary RGBA: colour rgb with opacity a; gloss r =
// shininess / 255, g = eta / 2, b = mirror; emissive rgb.
//     ambient  = La Ma base occlusion              diffuse = Ld Md base max(N.L, 0) visibility att
//     specular = Ls Ms max(R.V, 0)^shininess visibility att          att = I / (c + l d + q d^2)
//     phong = Me + emissive + sum over lights;  color = mix(mix(refraction, phong, a), reflection,
//     mirror)
// Without a gloss map: the material's shininess, eta 1, mirror 0. pow(0, 0) is 1. A shininess below
// 0, of a texel outside of [0, 1], is 0.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/lights.hpp"

namespace quadrel {

struct ShadeThesis : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-thesis", "shade",
                                    "Phong lighting with reflection and refraction",
                                    "correction of shade-thesis@published"};
    static constexpr auto inputs = lit_inputs;
    static constexpr auto outputs = shade_outputs;
    static constexpr auto textures = slots(TextureSlot::color, TextureSlot::gloss,
                                           TextureSlot::emissive, TextureSlot::environment);
    using Params = MapParams;
    static constexpr auto parameters = map_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const F zero(0), one(1);
        const vec4<F> base =
            map_at_hit<TextureSlot::color>(io, vec4<F>(one, one, one, one), params.gradients);
        const F default_shininess(io.material().shininess / 255.0f);
        const vec4<F> gloss = map_at_hit<TextureSlot::gloss>(
            io, vec4<F>(default_shininess, F(0.5f), zero, one), params.gradients);
        const Emission<F> emissive = emission_at_hit(io, params.gradients);
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        const vec3<F> N = io.template load<Value::N>();
        const F shininess = max(F(255) * gloss.x, zero);
        const LightTerms<F> sum = sum_lights(io, rgb(base), N, [&](const vec3<F>& L, F) {
            return pow(max(dot(reflect(-L, N), V), zero), shininess);
        });
        const vec3<F> phong = emissive.with(sum.ambient) + sum.diffuse + sum.specular;
        const vec3<F> mirrored = reflect(-V, N);
        const vec3<F> bent = refract(-V, N, F(2) * gloss.y);
        const Mask<F> total = dot(bent, bent) == zero;
        const vec3<F> reflection = environment<F>(io, mirrored);
        const vec3<F> refraction = environment<F>(io, select(total, mirrored, bent));

        io.template store<Value::light_ambient>(sum.ambient);
        io.template store<Value::light_diffuse>(sum.diffuse);
        io.template store<Value::light_specular>(sum.specular);
        io.template store<Value::light_emissive>(emissive.light);
        io.template store<Value::light_reflection>(reflection);
        io.template store<Value::light_refraction>(refraction);
        io.template store<Value::color>(mix(mix(refraction, phong, base.w), reflection, gloss.z));
        io.template store<Value::opacity>(base.w);
    }

  private:
    template <class F, class Io>
    static vec3<F> environment(Io& io, const vec3<F>& v) {
        const SampledTexture* cube = io.template texture<TextureSlot::environment>();
        if (!cube) return vec3<F>(F(0));
        const auto& m = io.frame().eye_to_world;
        const vec3<F> world{F(m[0]) * v.x + F(m[1]) * v.y + F(m[2]) * v.z,
                            F(m[3]) * v.x + F(m[4]) * v.y + F(m[5]) * v.z,
                            F(m[6]) * v.x + F(m[7]) * v.y + F(m[8]) * v.z};
        return rgb(texture_cube(*cube, io.template context<TextureSlot::environment>(), world,
                                io.frame().derivatives));
    }
};

}  // namespace quadrel
