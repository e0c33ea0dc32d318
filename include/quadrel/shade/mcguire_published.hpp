// shade-mcguire@published: the lighting of the page's shader, as published.
//
// Source: M. McGuire and M. McGuire, "Steep Parallax Mapping" (2005), the page's shader. Kept: the
// colours are the listing's constants, only the first light's direction and shadow count; where
// N.L > 0 the light is made brighter by 1.2, "shadows will make the whole scene darker"; sums may
// exceed 1. The listing's selfShadow is 1 where the light arrives: shadow.visibility. Its spec is
// never used. The light vector is that of the vertices, interpolated (tangent_light.hpp); the
// normal is what the chosen surface stage made, normal-mcguire@published as the page does. The
// colour's look-up takes the implicit derivatives of the displaced coordinate. Ambient occlusion,
// which the page has none of, multiplies the ambient term: 1 unless chosen.
// Not reproduced: the page's vertex shader, which it does not show; vertex_frame.hpp names the one
// that is taken.
#pragma once

#include "quadrel/relief/tangent_light.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeMcGuirePublished : TangentShade {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-mcguire@published", "shade",
                                    "matte light over strong ambient light",
                                    "McGuire and McGuire, Steep Parallax Mapping (2005)"};
    static constexpr const char* not_reproduced =
        "the vertex shader, which the page does not show: G3D's bump.vert of 2004 stands in its "
        "place";
    static constexpr auto inputs =
        values_and(tangent_light_inputs, Value::hit_uv, Value::shadow_visibility, Value::occlusion);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = listed_map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const vec3<F> color = rgb(rgba);
        const vec3<F> ambient = vec3<F>(F(0.4f), F(0.4f), F(0.6f)) * F(1.4f);
        vec3<F> light_color = vec3<F>(F(1.5f), F(1.5f), F(1)) * F(0.9f);
        F NdotL(0), visibility(0);
        if (io.frame().light_count > 0) {
            const TangentLight light(io);
            const vec3<F> tsL = normalize(light.to(io.frame().lights[0]));
            NdotL = max(F(0), dot(light.normal(), tsL));
            const Mask<F> lit = NdotL > F(0);
            visibility = select(lit, io.template load<Value::shadow_visibility>(0), F(0));
            light_color = select(lit, light_color * F(1.2f), light_color);
        }
        const vec3<F> ambient_term = color * ambient * io.template load<Value::occlusion>();
        io.template store<Value::color>(ambient_term + color * NdotL * visibility * light_color);
        io.template store<Value::opacity>(rgba.w);
    }
};

}  // namespace quadrel
