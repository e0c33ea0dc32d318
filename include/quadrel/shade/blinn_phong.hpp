// shade-blinn-phong: the highlight is a power of the cosine between normal and half vector.
//
// Source: J. Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977.
//     s = max(N.H, 0)^shininess,   H = normalize(L + V),   where N.L > 0
// Not normalised; about four times Phong's exponent gives a highlight of the same size. pow(0, 0)
// is 1. A light straight behind the point has no half vector; it lights nothing.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/shade/lit.hpp"

namespace quadrel {

/// Blinn's s at the point, of a light from L.
template <Number F>
F blinn_highlight(const LitPoint<F>& at, const vec3<F>& L) {
    const vec3<F> sum = L + at.V;
    const F squared = dot(sum, sum);
    const F cosine = dot(at.N, sum) * inversesqrt(squared);
    return pow(select(squared > F(0), max(cosine, F(0)), F(0)), at.shininess);
}

struct ShadeBlinnPhong : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "shade-blinn-phong", "shade", "Blinn's highlight over a matte base",
        "Blinn, Models of Light Reflection for Computer Synthesized Pictures (1977)"};
    static constexpr bool reads_first_gloss_only = true;  // the exponent

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LitPoint<F> at = lit_point(io, params.gradients);
        shade_lit(
            io, at.N, [&](const vec3<F>& L, F) { return blinn_highlight(at, L); },
            params.gradients);
    }
};

}  // namespace quadrel
