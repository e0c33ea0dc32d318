// Lights at a shading point, and the sum over them that the reflection models share.
//
//     ambient  = La Ma base                    per light, times the ambient occlusion in all
//     diffuse  = Ld Md base max(N.L, 0) a      a = visibility I / (c + l d + q d^2)
//     specular = Ls Ms s(L) a, or Ls s(L) a    where N.L > 0; s is the model's
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

template <Number F>
struct LightTerms {
    vec3<F> ambient = vec3<F>(F(0)), diffuse = vec3<F>(F(0)), specular = vec3<F>(F(0));
};

/// What a model of two layers says of one light: the share of the light that reaches the matte
/// base and leaves it, and the highlight above it in its own colour.
template <Number F>
struct Layers {
    F matte;
    vec3<F> specular;
};

/// `specular(L, N.L)`: a number, to be multiplied by the light's and the material's colours, or a
/// colour, by the light's alone, or Layers, the share of diffuse light beside that. It is only used
/// where N.L > 0.
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
        constexpr bool has_layers = std::is_same_v<decltype(highlight), const Layers<F>>;
        const F lit = select(cosine > F(0), visible, F(0));
        F arriving = max(cosine, F(0)) * visible;
        if constexpr (has_layers)
            arriving = select(cosine > F(0), arriving * highlight.matte, F(0));
        sum.ambient += uniform3<F>(light.ambient) * uniform3<F>(material.ambient) * base;
        sum.diffuse += uniform3<F>(light.diffuse) * uniform3<F>(material.diffuse) * base * arriving;
        if constexpr (has_layers) {
            sum.specular += uniform3<F>(light.specular) *
                            select(lit > F(0), highlight.specular * lit, vec3<F>(F(0)));
        } else if constexpr (std::is_same_v<decltype(highlight), const F>) {
            sum.specular += uniform3<F>(light.specular) * uniform3<F>(material.specular) *
                            select(lit > F(0), highlight * lit, F(0));  // a power may be infinite
        } else {
            sum.specular +=
                uniform3<F>(light.specular) * select(lit > F(0), highlight * lit, vec3<F>(F(0)));
        }
    }
    sum.ambient = sum.ambient * io.template load<Value::occlusion>();
    return sum;
}

}  // namespace quadrel
