// shade-phong: the highlight is a power of the cosine between view and mirrored light.
//
// Source: B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18 (1975).
//     s = max(R.V, 0)^shininess,   R = 2 (N.L) N - L,   where N.L > 0
// Not normalised: a higher exponent makes the highlight smaller, not brighter. pow(0, 0) is 1.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/lit.hpp"

namespace quadrel {

struct ShadePhong : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-phong", "shade", "Phong's highlight over a matte base",
                                    "Phong, Illumination for Computer Generated Pictures (1975)"};
    static constexpr bool reads_first_gloss_only = true;  // the exponent

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LitPoint<F> at = lit_point(io, params.gradients);
        shade_lit(
            io, at.N,
            [&](const vec3<F>& L, F) {
                return pow(max(dot(reflect(-L, at.N), at.V), F(0)), at.shininess);
            },
            params.gradients);
    }
};

}  // namespace quadrel
