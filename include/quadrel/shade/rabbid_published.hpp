// shade-rabbid@published: the lighting of Rabbid76's listing, as published.
//
// Source: "Normal, Parallax and Relief mapping" (Rabbid76, graphics-snippets), main, from "ambient
// part" on. One white light; u_ambient, u_diffuse, u_specular are the first components of the
// material's colours, u_shininess its shininess. Kept: the highlight has the base's colour, is not
// multiplied by N.L and is not cut off on the unlit side; no shadow. The listing's light has a
// direction alone; a light at a point, which it does not know, is seen from the displaced point.
// The colour's look-up takes the implicit derivatives of the displaced coordinate. Ambient
// occlusion, which the listing has none of, multiplies the ambient term: 1 unless chosen.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeRabbidPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-rabbid@published", "shade",
                                    "Blinn-Phong, the highlight times (k + 2) / (2 pi)",
                                    "Rabbid76, Normal, Parallax and Relief mapping"};
    static constexpr auto inputs =
        values(Value::P, Value::hit_P, Value::hit_uv, Value::N, Value::occlusion);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = listed_map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const vec3<F> color = rgb(rgba);
        const MaterialUniforms& m = io.material();
        vec3<F> light = color * F(m.ambient[0]) * io.template load<Value::occlusion>();
        if (io.frame().light_count > 0) light = lit<F>(io, color, light);
        io.template store<Value::color>(light);
        io.template store<Value::opacity>(rgba.w);
    }

  private:
    /// `light` with diffuse and specular light added, in that order.
    template <class F, class Io>
    static vec3<F> lit(Io& io, const vec3<F>& color, vec3<F> light) {
        const MaterialUniforms& m = io.material();
        const vec3<F> normal = normalize(io.template load<Value::N>());
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), io.frame().lights[0]);
        const vec3<F> eye = to_viewer(io.template load<Value::P>(), io.frame());
        const F NdotL = max(F(0), dot(normal, L));
        const F NdotH = max(F(0), dot(normal, normalize(eye + L)));
        const F shininess(m.shininess);
        const F k_specular = (shininess + F(2)) * pow(NdotH, shininess) / (F(2) * F(3.14159265f));
        light = light + color * (NdotL * F(m.diffuse[0]));
        return light + color * (k_specular * F(m.specular[0]));
    }
};

}  // namespace quadrel
