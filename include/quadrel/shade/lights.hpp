// Lights at a shading point, and the sum over them that the reflection models share.
//
//     ambient  = La Ma base                    per light, times the ambient occlusion in all
//     diffuse  = Ld Md base max(N.L, 0) a      a = visibility I / (c + l d + q d^2)
//     specular = Ls Ms s(L) a, or Ls s(L) a    where N.L > 0; s is the model's
// Sums begin with their first term, not with 0: 0 + -0 is 0, but a GPU's compiler may leave 0 out
// (GLSL 4.60, 4.7.1: zeros of two signs may be interchanged), and it is not what a person writes.
// Colours are such that a white surface which faces a white light of intensity 1 is white: the
// light's irradiance over pi.
#pragma once

#include <type_traits>

#include "quadrel/shade/maps.hpp"

namespace quadrel {

/// What the sum over lights loads.
inline constexpr auto lit_inputs =
    values(Value::P, Value::dUVdx, Value::dUVdy, Value::hit_P, Value::hit_uv, Value::N,
           Value::shadow_visibility, Value::occlusion);

/// Intensity over the distance polynomial; directional lights do not fade.
template <Number F>
F attenuation(const vec3<F>& P, const auto& light) {
    if (light.directional) return F(light.intensity);
    F sum(light.attenuation[0]);
    if (light.attenuation[1] == 0 && light.attenuation[2] == 0) return F(light.intensity) / sum;
    // A term that is not there is none, however far the light is: 0 times infinity is NaN.
    const F d = distance(uniform3<F>(light.position), P);
    if (light.attenuation[1] != 0) sum = sum + F(light.attenuation[1]) * d;
    if (light.attenuation[2] != 0) sum = sum + F(light.attenuation[2]) * (d * d);
    return F(light.intensity) / sum;
}

/// A sum of light and one more term; the first term alone begins it.
template <Number F>
vec3<F> light_sum(bool is_first, const vec3<F>& sum, const vec3<F>& term) {
    return is_first ? term : sum + term;
}

/// What a model without a highlight gives for one.
struct NoHighlight {};

template <Number F>
struct LightTerms {
    vec3<F> ambient = vec3<F>(F(0)), diffuse = vec3<F>(F(0)), specular = vec3<F>(F(0));
};

/// Both lobes of a model's reflection of one light: the share of the light that the matte lobe has,
/// below a glaze, and the specular one in its own colour.
template <Number F>
struct ReflectionLobes {
    F matte;
    vec3<F> specular;
};

template <class Highlight>
Highlight shine_of(const Highlight& highlight) {
    return highlight;
}
template <Number F>
vec3<F> shine_of(const ReflectionLobes<F>& lobes) {
    return lobes.specular;
}

/// `specular(L, N.L)`: a number, to be multiplied by the light's and the material's colours, or a
/// colour, by the light's alone, or ReflectionLobes, or NoHighlight. It is only used where
/// N.L > 0.
template <class Io, class Specular, class F = typename Io::Number>
LightTerms<F> sum_lights(const Io& io, const vec3<F>& base, const vec3<F>& N,
                         const Specular& specular) {
    LightTerms<F> sum;
    const vec3<F> P = io.template load<Value::hit_P>();
    const auto& material = io.material();
    for (int i = 0; i < io.frame().light_count; ++i) {
        const auto& light = io.frame().lights[i];
        const vec3<F> L = to_light(P, light);
        const F visible = io.template load<Value::shadow_visibility>(i) * attenuation(P, light);
        const F cosine = dot(N, L);
        const auto highlight = specular(L, cosine);
        using Highlight = std::remove_const_t<decltype(highlight)>;
        const auto add = [i](vec3<F>& to, const vec3<F>& by) { to = light_sum(i == 0, to, by); };
        F arriving = max(cosine, F(0)) * visible;
        if constexpr (std::is_same_v<Highlight, ReflectionLobes<F>>)
            arriving = select(cosine > F(0), arriving * highlight.matte, F(0));
        add(sum.ambient, uniform3<F>(light.ambient) * uniform3<F>(material.ambient) * base);
        add(sum.diffuse,
            uniform3<F>(light.diffuse) * uniform3<F>(material.diffuse) * base * arriving);
        if constexpr (!std::is_same_v<Highlight, NoHighlight>) {
            const F lit = select(cosine > F(0), visible, F(0));
            vec3<F> color = uniform3<F>(light.specular);
            if constexpr (std::is_same_v<Highlight, F>)
                color = color * uniform3<F>(material.specular);
            const auto shine = shine_of(highlight);
            const std::remove_const_t<decltype(shine)> dark(F(0));
            // A power may be infinite.
            add(sum.specular, color * select(lit > F(0), shine * lit, dark));
        }
    }
    sum.ambient = sum.ambient * io.template load<Value::occlusion>();
    return sum;
}

/// What the surface gives of itself: the material's emission and the emissive map.
template <Number F>
struct Emission {
    bool is_there = false;
    vec3<F> light = vec3<F>(F(0));

    vec3<F> with(const vec3<F>& terms) const { return light_sum(!is_there, light, terms); }
};

template <class Io, class F = typename Io::Number>
Emission<F> emission_at_hit(Io& io, std::int32_t gradients) {
    const auto& own = io.material().emission;
    const bool glows = own[0] != 0 || own[1] != 0 || own[2] != 0;
    const bool has_map = io.template texture<TextureSlot::emissive>() != nullptr;
    const vec4<F> map = map_at_hit<TextureSlot::emissive>(io, vec4<F>(F(0)), gradients);
    return {glows || has_map, glows ? uniform3<F>(own) + rgb(map) : rgb(map)};
}

}  // namespace quadrel
