// shade-metallic-roughness: the material of glTF: a mirror of rough facets, of metal or of glaze
// over a matte base.
//
// Source: The Khronos Group, glTF 2.0 Specification, 3.9.2 and appendix B.
//     matte    = (1 - m) (1 - F(0.04))                     of the base colour, B.3.4
//     specular = pi ((1 - m) F(0.04) + m F(base)) D V N.L  times the light, irradiance over pi
//     F(F0) = F0 + (1 - F0) (1 - V.H)^5                    Schlick
//     D = a^2 / (pi ((N.H)^2 a^2 + |N x H|^2)^2)           Trowbridge and Reitz; in the text as
//                                                          (N.H)^2 (a^2 - 1) + 1, which cancels
//     V = 1 / ((N.L + sqrt(a^2 + (1 - a^2) (N.L)^2)) (N.V + sqrt(a^2 + (1 - a^2) (N.V)^2)))   Smith
// base is the colour map times the material's `diffuse`, a the square of the roughness, at least
// 0.001. Gloss map, as glTF packs it: r dims ambient light, g times `roughness`, b times
// `metalness`. The material's `specular` and shininess are not read. Nothing where N.L or N.V is
// not positive. By the definition a white glazed base at grazing angles reflects up to a tenth more
// than arrives. Differs: ambient light is the base's alone, there being no environment.
#pragma once

#include "quadrel/shade/lit.hpp"

namespace quadrel {

/// Schlick's approximation; `rest` is (1 - V.H)^5.
template <Number F>
F fresnel_schlick(F F0, F rest) {
    return F0 + (F(1) - F0) * rest;
}

/// Trowbridge's and Reitz' distribution of facet normals; `across` is the squared length of N x H.
template <Number F>
F trowbridge_reitz(F NH, F across, F a2) {
    const F pi(static_cast<Scalar<F>>(3.14159265358979324));
    const F spread = NH * NH * a2 + across;
    return a2 / (pi * spread * spread);
}

/// One half of Smith's visibility of facets; the cosine is positive.
template <Number F>
F smith_visibility(F cosine, F a2) {
    return F(1) / (cosine + sqrt(a2 + (F(1) - a2) * cosine * cosine));
}

struct ShadeMetallicRoughness : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-metallic-roughness", "shade",
                                    "rough metal, or a rough glaze over a matte base",
                                    "The Khronos Group, glTF 2.0 Specification, appendix B; times "
                                    "pi, as a light's unit is irradiance over pi"};
    struct Params {
        float roughness = 1, metalness = 1, occlusion_strength = 1;
        std::int32_t gradients = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::roughness>("roughness", "1", "of the facets, times the map's g", 0, 1,
                                      1),
        parameter<&Params::metalness>("metalness", "1", "1 for metal, times the map's b", 0, 1, 1),
        parameter<&Params::occlusion_strength>("occlusion_strength", "1",
                                               "how much of the map's r is applied", 0, 1, 1),
        gradients_parameter<&Params::gradients>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> N = io.template load<Value::N>();
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        const vec4<F> base = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)), params.gradients);
        const vec4<F> gloss = map_at_hit<TextureSlot::gloss>(io, vec4<F>(F(1)), params.gradients);
        const Emission<F> emissive = emission_at_hit(io, params.gradients);
        const F roughness = F(params.roughness) * gloss.y;
        const Facets<F> facets{max(roughness * roughness, F(0.001f)), F(params.metalness) * gloss.z,
                               uniform3<F>(io.material().diffuse) * rgb(base)};
        LightTerms<F> sum = sum_lights(io, rgb(base), N, [&](const vec3<F>& L, F NL) {
            return reflected(facets, N, V, L, NL);
        });
        sum.ambient = sum.ambient * (F(1) + F(params.occlusion_strength) * (gloss.x - F(1)));
        store_lit(io, sum, base, emissive);
    }

  private:
    template <Number F>
    struct Facets {
        F a, metalness;
        vec3<F> base;
    };

    template <class F>
    static ReflectionLobes<F> reflected(const Facets<F>& facets, const vec3<F>& N, const vec3<F>& V,
                                        const vec3<F>& L, F NL) {
        const vec3<F> H = normalize(L + V), NxH = cross(N, H);
        const F NV = dot(N, V), slant = F(1) - min(F(1), max(F(0), dot(V, H)));
        const F rest = slant * slant * slant * slant * slant, a2 = facets.a * facets.a;
        const F glaze = fresnel_schlick(F(0.04f), rest), matte = F(1) - facets.metalness;
        const F pi(static_cast<Scalar<F>>(3.14159265358979324));
        const F mirrored = pi * trowbridge_reitz(dot(N, H), dot(NxH, NxH), a2) *
                           smith_visibility(NL, a2) * smith_visibility(NV, a2) * NL;
        vec3<F> specular;
        for (int c = 0; c < 3; ++c) {
            const F metal = fresnel_schlick(facets.base[c], rest);
            specular[c] = (matte * glaze + facets.metalness * metal) * mirrored;
        }
        const Mask<F> faces = (NL > F(0)) & (NV > F(0));
        return {matte * (F(1) - glaze), select(faces, specular, vec3<F>(F(0)))};
    }
};

}  // namespace quadrel
