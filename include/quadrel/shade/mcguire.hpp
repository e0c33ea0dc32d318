// shade-mcguire: matte light over strong ambient light, not clamped, with the page's highlight.
//
// Generalises shade-mcguire@published: lights, their colours, intensity and attenuation, and the
// material's colours are the scene's; the highlight (N.H)^2, which the page computes and never
// uses, is added with the specular colours (black leaves it out). Terms: lights.hpp.
#pragma once

#include "quadrel/shade/lit.hpp"

namespace quadrel {

struct ShadeMcGuire : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-mcguire", "shade", "matte with a broad highlight",
                                    "generalisation of shade-mcguire@published"};
    static constexpr auto textures = slots(TextureSlot::color, TextureSlot::emissive);

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> N = io.template load<Value::N>();
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        shade_lit(
            io, N,
            [&](const vec3<F>& L, F cosine) {
                const F NdotH = max(F(0), dot(N, normalize(L + V)));
                return select(cosine > F(0), NdotH * NdotH, F(0));
            },
            params.gradients);
    }
};

}  // namespace quadrel
