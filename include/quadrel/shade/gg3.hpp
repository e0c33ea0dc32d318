// shade-gg3: the lighting of relief_mapping.fx, as listed.
//
// Source: F. Policarpo and M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// chapter 18 (2007), relief_mapping.fx on the book's disc. One white light; ambient, diffuse,
// specular and shine are the material's (the file's defaults: 0.2, 1, 0.75, 32).
//     att = 1 - (1 - max(0, l.z))^2;   diff = saturate(l.n);   spec = saturate(normalize(l - e).n)
//     color = ambient c + att (c diffuse diff + specular spec^shine)
// l.z is the light's cosine with the vertices' normal, e the ray from eye to surface. Both vectors
// are those of the vertex program, interpolated (tangent_light.hpp): along the tangent, binormal
// and normal that the model view matrix itself turns and scales. Kept: att darkens twice what lies
// at a slant; the highlight does not ask for l.n > 0; no shadow, no distance; the colour's look-up
// takes the implicit derivatives of the displaced coordinate. A directional light, which the file
// does not know, has its direction everywhere; ambient occlusion, likewise, multiplies the ambient
// term: 1 unless chosen. Not reproduced: the border clamp and the alpha test.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/relief/tangent_light.hpp"
#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeGg3 : TangentShade {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-gg3", "shade",
                                    "Blinn-Phong, faded by the light's elevation",
                                    "GPU Gems 3, chapter 18, relief_mapping.fx"};
    static constexpr const char* not_reproduced =
        "border clamp and alpha test; depth bias and tile factor, which are the search's";
    static constexpr auto inputs =
        values_and(tangent_light_inputs, Value::hit_uv, Value::occlusion);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> rgba = listed_map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
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
        const TangentLight light(io);
        const vec3<F> n = light.normal();
        const vec3<F> l = normalize(vector_to(io, light, io.frame().lights[0]));
        const vec3<F> e = normalize(vector_from_eye(io, light));
        const F l_z = select(light.framed(), l.z, dot(l, io.template load<Value::frame_normal>()));
        const F diff = saturate(dot(l, n));
        const F spec = saturate(dot(normalize(l - e), n));
        F att = F(1) - max(F(0), l_z);
        att = F(1) - att * att;
        const vec3<F> diffuse = c * uniform3<F>(m.diffuse) * diff;
        return (diffuse + uniform3<F>(m.specular) * pow(spec, F(m.shininess))) * att;
    }

    /// OUT.light: mul(tangentspace, light.xyz - vpos).
    template <class Io, class F = typename Io::Number>
    static vec3<F> vector_to(const Io& io, const TangentLight<Io>& light, const auto& uniforms) {
        const vec3<F> position = uniform3<F>(uniforms.position);
        const auto from = [&](const vec3<F>& vpos) {
            return uniforms.directional ? position : position - vpos;
        };
        const auto& program = light.program();
        return light.varying(
            [&](const Vertex<F>& v) {
                return tangentspace(program, v, from(program.point_to_eye(v.position)));
            },
            from(io.template load<Value::P>()));
    }
    /// OUT.eye: mul(tangentspace, vpos).
    template <class Io, class F = typename Io::Number>
    static vec3<F> vector_from_eye(const Io& io, const TangentLight<Io>& light) {
        const auto& program = light.program();
        return light.varying(
            [&](const Vertex<F>& v) {
                return tangentspace(program, v, program.point_to_eye(v.position));
            },
            io.template load<Value::P>());
    }
    template <class Program, class F = typename Program::F>
    static vec3<F> tangentspace(const Program& program, const Vertex<F>& v, const vec3<F>& x) {
        return {dot(program.vector_to_eye(v.tangent), x), dot(program.vector_to_eye(v.binormal), x),
                dot(program.vector_to_eye(v.normal), x)};
    }
};

}  // namespace quadrel
