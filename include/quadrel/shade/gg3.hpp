// shade-gg3: the lighting of relief_mapping.fx, as listed.
//
// Source: F. Policarpo and M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// chapter 18 (2007), relief_mapping.fx on the book's disc. One white light; ambient, diffuse,
// specular and shine are the material's (the file's defaults: 0.2, 1, 0.75, 32).
//     att = 1 - (1 - max(0, l.z))^2;   diff = saturate(l.n);   spec = saturate(normalize(l - e).n)
//     color = ambient c + att (c diffuse diff + specular spec^shine)
// l.z is the light's cosine with the frame's normal, e the ray from eye to surface. Kept: att
// darkens twice what lies at a slant; the highlight does not ask for l.n > 0; no shadow, no
// distance. Ambient occlusion, which the file has none of, multiplies the ambient term: 1 unless
// chosen. The vectors are in eye space instead of tangent space.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeGg3 : StageDefaults {
    static constexpr StageText text{"shade-gg3", "shade",
                                    "Blinn-Phong, faded by the light's elevation",
                                    "GPU Gems 3, chapter 18, relief_mapping.fx"};
    static constexpr auto inputs =
        values(Value::P, Value::dUVdx, Value::dUVdy, Value::hit_P, Value::hit_uv, Value::N,
               Value::frame_normal, Value::occlusion);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const vec3<F> c = rgb(rgba);
        const vec3<F> ambient =
            uniform3<F>(io.material().ambient) * c * io.template load<Value::occlusion>();
        const bool any_light = io.frame().light_count > 0;
        io.template store<Value::color>(any_light ? ambient + lit<F>(io, c) : ambient);
        io.template store<Value::opacity>(rgba.w);
    }

  private:
    template <class F, class Io>
    static vec3<F> lit(Io& io, const vec3<F>& c) {
        const MaterialUniforms& m = io.material();
        const vec3<F> n = io.template load<Value::N>();
        const vec3<F> l = to_light(io.template load<Value::hit_P>(), io.frame().lights[0]);
        const vec3<F> e = -to_viewer(io.template load<Value::P>(), io.frame());
        const F diff = saturate(dot(l, n));
        const F spec = saturate(dot(normalize(l - e), n));
        F att = F(1) - max(F(0), dot(l, io.template load<Value::frame_normal>()));
        att = F(1) - att * att;
        const vec3<F> diffuse = c * uniform3<F>(m.diffuse) * diff;
        return (diffuse + uniform3<F>(m.specular) * pow(spec, F(m.shininess))) * att;
    }
};

}  // namespace quadrel
