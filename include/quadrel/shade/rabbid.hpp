// shade-rabbid: Blinn-Phong with a highlight of constant energy.
//
// Corrects shade-rabbid@published: the highlight takes the cosine of the light (its factor
// (k + 2) / (2 pi) is normalised for a power times that cosine, which the listing leaves out) and
// is no highlight on the unlit side; colours, intensity, attenuation and shadows of every light;
// the highlight has the material's colour instead of the base's. Terms: lights.hpp.
//     s = (k + 2) / (2 pi) max(N.H, 0)^k N.L
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/lit.hpp"

namespace quadrel {

struct ShadeRabbid : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-rabbid", "shade",
                                    "Blinn-Phong with a normalised highlight",
                                    "correction of shade-rabbid@published"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LitPoint<F> at = lit_point(io, params.gradients);
        const F two_pi(static_cast<Scalar<F>>(6.28318530717958648));
        const F scale = (at.shininess + F(2)) / two_pi;
        shade_lit(
            io, at.N,
            [&](const vec3<F>& L, F NdotL) {
                const F NdotH = max(F(0), dot(at.N, normalize(L + at.V)));
                return select(NdotL > F(0), scale * pow(NdotH, at.shininess) * NdotL, F(0));
            },
            params.gradients);
    }
};

}  // namespace quadrel
