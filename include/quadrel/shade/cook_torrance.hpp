// shade-cook-torrance: mirrors in microfacets over a matte base.
//
// Source: R. Cook and K. Torrance, "A Reflectance Model for Computer Graphics", ACM TOG 1(1), 1982.
//     s = pi D F G / (4 N.V)      (times the light, which is irradiance over pi; N.L cancels)
//     D = exp(-tan^2 a / m^2) / (pi m^2 cos^4 a),  cos a = N.H          Beckmann
//     G = min(1, 2 (N.H)(N.V) / (V.H), 2 (N.H)(N.L) / (V.H))            V-shaped grooves
//     F = ((g - c) / (g + c))^2 / 2 (1 + ((c (g + c) - 1) / (c (g - c) + 1))^2),
//         c = V.H,  g^2 = n^2 + c^2 - 1,  n = (1 + sqrt F0) / (1 - sqrt F0)   unpolarised Fresnel
// F0, the reflectance at normal incidence, is the material's `specular`, at most 0.98. Differs: the
// paper's D has no pi and its divisor is pi instead of 4, four times more than facets reflect.
// The slope m is `roughness`; 0: from shininess and gloss map, m^2 = 2 / (shininess + 2), the
// Gaussian nearest to Blinn's power. Nothing where N.L or N.V is not positive.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/lit.hpp"

namespace quadrel {

/// Beckmann's distribution of facet normals; `m2` is the slope squared, cosine in (0, 1].
template <Number F>
F beckmann(F cosine, F m2) {
    const F c2 = max(cosine * cosine, F(1e-6f));  // below, D is 0 anyway
    const F pi(static_cast<Scalar<F>>(3.14159265358979324));
    return exp((c2 - F(1)) / (c2 * m2)) / (pi * m2 * c2 * c2);
}

/// Share of the light that two-sided V grooves let pass; all cosines positive.
template <Number F>
F groove_attenuation(F NH, F NV, F NL, F VH) {
    const F twice = F(2) * NH / VH;
    return min(F(1), min(twice * NV, twice * NL));
}

/// Fresnel reflectance of unpolarised light of a dielectric with reflectance F0 in [0, 0.98] at
/// normal incidence; c is the cosine, in [0, 1].
template <Number F>
F fresnel_dielectric(F F0, F c) {
    const F root = sqrt(F0);
    const F n = (F(1) + root) / (F(1) - root);
    const F g = sqrt(n * n + c * c - F(1));
    const F across = (g - c) / (g + c), along = (c * (g + c) - F(1)) / (c * (g - c) + F(1));
    return F(0.5f) * across * across * (F(1) + along * along);
}

struct ShadeCookTorrance : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-cook-torrance", "shade", "microfacets over a matte base",
                                    "Cook and Torrance, A Reflectance Model for Computer Graphics "
                                    "(1982)"};
    static constexpr bool reads_first_gloss_only = true;  // the exponent
    struct Params {
        float roughness = 0;
        std::int32_t gradients = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::roughness>("roughness", "1", "slope m of the facets; 0: from shininess",
                                      0, 4, 0),
        gradients_parameter<&Params::gradients>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LitPoint<F> at = lit_point(io, params.gradients);
        const F given(params.roughness * params.roughness);
        const F m2 = params.roughness > 0 ? max(given, F(1e-6f)) : F(2) / (at.shininess + F(2));
        shade_lit(
            io, at.N, [&](const vec3<F>& L, F NL) { return specular<F>(io, at, m2, L, NL); },
            params.gradients);
    }

  private:
    template <class F, class Io>
    static vec3<F> specular(Io& io, const LitPoint<F>& at, F m2, const vec3<F>& L, F NL) {
        // H = (L + V) / |L + V|, and V.H = |L + V| / 2 of unit vectors.
        const F sum = length(L + at.V), NV = dot(at.N, at.V);
        const F NH = min((NL + NV) / sum, F(1)), VH = min(F(0.5f) * sum, F(1));
        const F pi(static_cast<Scalar<F>>(3.14159265358979324));
        const F facets = pi * beckmann(NH, m2) * groove_attenuation(NH, NV, NL, VH) / (F(4) * NV);
        vec3<F> result;
        for (int c = 0; c < 3; ++c) {
            const F F0(std::min(io.material().specular[c], 0.98f));
            result[c] = fresnel_dielectric(F0, VH) * facets;
        }
        return select((NL > F(0)) & (NV > F(0)), result, vec3<F>(F(0)));
    }
};

}  // namespace quadrel
