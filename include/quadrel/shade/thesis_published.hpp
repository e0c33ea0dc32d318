// shade-thesis@published: the lighting of the thesis, as published.
//
// Source: "Derivative-Based Relief Mapping" (2012), appendix, Parallax.frag, sections 2 to 4.
// One light. Kept as listed: diffuse is not clamped; the diffuse and specular light colours beyond
// Light0_Specular * Material_Specular, the intensity and the attenuations are not used; the normal
// is not normalised; refract() may return 0, whose normalisation is NaN; the environment is looked
// up with eye-space vectors. What a look-up at NaN gives is the implementation's choice: hit.flags
// says nan-look-up there, and where a mip level is chosen by a difference with such a fragment. The
// note on A8R8G8B8 bitmaps makes .r alpha and .gba the colour: the colour map is read so, the gloss
// and emissive maps are not (.r .g .b is A, R, G). Ambient occlusion, which the listing has none
// of, multiplies the ambient term: 1 unless chosen. An unbound map reads as 0 in those channels.
// pow(0, 0) is 1.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeThesisPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "shade-thesis@published", "shade", "the thesis' lighting with environment maps",
        "Derivative-Based Relief Mapping (2012), appendix, Parallax.frag 2-4"};
    static constexpr const char* not_reproduced =
        "what a GPU makes of a look-up at NaN: hit.flags says nan-look-up there";
    static constexpr auto inputs = values(Value::P, Value::hit_P, Value::hit_uv, Value::hit_flags,
                                          Value::N, Value::shadow_visibility, Value::occlusion);
    static constexpr auto outputs = values_and(shade_outputs, Value::hit_flags);
    static constexpr auto textures = slots(TextureSlot::color, TextureSlot::gloss,
                                           TextureSlot::emissive, TextureSlot::environment);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> color_map = argb<TextureSlot::color, F>(io);
        const vec4<F> gloss = argb<TextureSlot::gloss, F>(io);
        const vec4<F> glow = argb<TextureSlot::emissive, F>(io);
        const vec3<F> base(color_map.y, color_map.z, color_map.w);  // .gba
        const vec3<F> N = io.template load<Value::N>();
        const vec3<F> E = to_viewer(io.template load<Value::P>(), io.frame());
        const F shininess = F(255) * gloss.x, eta = F(2) * gloss.y, mirror = gloss.z;
        const vec3<F> reflected = normalize(reflect(-E, N));
        const vec3<F> refracted = normalize(refract(-E, N, eta));

        const auto& light = io.frame().lights[0];
        const bool lit = io.frame().light_count > 0;
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), light);
        const F intensity = lit ? io.template load<Value::shadow_visibility>(0) : F(0);
        const vec3<F> ambient =
            uniform3<F>(light.ambient) * base * io.template load<Value::occlusion>();
        const vec3<F> diffuse = base * (dot(N, L) * intensity);
        const F highlight = pow(max(dot(reflect(-L, N), E), F(0)), shininess) * intensity;
        const vec3<F> specular =
            uniform3<F>(light.specular) * uniform3<F>(io.material().specular) * highlight;
        const vec3<F> emissive(glow.x, glow.y, glow.z);
        const vec3<F> phong = emissive + ambient + diffuse + specular;
        const vec3<F> reflection = environment<F>(io, reflected);
        const vec3<F> refraction = environment<F>(io, refracted);

        io.template store<Value::light_ambient>(ambient);
        io.template store<Value::light_diffuse>(diffuse);
        io.template store<Value::light_specular>(specular);
        io.template store<Value::light_emissive>(emissive);
        io.template store<Value::light_reflection>(reflection);
        io.template store<Value::light_refraction>(refraction);
        io.template store<Value::color>(
            mix(mix(refraction, phong, color_map.x), reflection, mirror));
        io.template store<Value::opacity>(color_map.x);
        io.template store<Value::hit_flags>(io.template load<Value::hit_flags>() |
                                            look_up_flags(io, reflected) |
                                            look_up_flags(io, refracted));
    }

  private:
    /// texture(map, UV) in the channel order A R G B.
    template <TextureSlot slot, class F, class Io>
    static vec4<F> argb(Io& io) {
        const SampledTexture* map = io.template texture<slot>();
        if (!map) return vec4<F>(F(0));
        const vec4<F> t = texture(*map, io.template context<slot>(),
                                  io.template load<Value::hit_uv>(), io.frame().derivatives);
        return {t.w, t.x, t.y, t.z};
    }

    template <class Io, class F>
    static Int<F> look_up_flags(Io& io, const vec3<F>& direction) {
        const SampledTexture* cube = io.template texture<TextureSlot::environment>();
        if (!cube) return Int<F>(0);
        const Int<F> flags = nan_look_up_flag(direction);
        if (cube->view.levels == 1) return flags;
        const DerivativeMode mode = io.frame().derivatives;
        return flags | nan_look_up_flag(dFdx(direction, mode)) |
               nan_look_up_flag(dFdy(direction, mode));
    }

    template <class F, class Io>
    static vec3<F> environment(Io& io, const vec3<F>& direction) {
        const SampledTexture* cube = io.template texture<TextureSlot::environment>();
        if (!cube) return vec3<F>(F(0));
        return rgb(texture_cube(*cube, io.template context<TextureSlot::environment>(), direction,
                                io.frame().derivatives));
    }
};

}  // namespace quadrel
