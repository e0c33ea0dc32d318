// h2n-sobel@published: normal from nine taps, as published.
//
// Source: "Normal, Parallax and Relief mapping" (Rabbid76, graphics-snippets), CalculateNormal, the
// version with nine heights. Defects kept: the Sobel sums are not divided by 8: slopes eight times
// too steep; implicit gradients of the displaced UV; the frame of rabbid.hpp.
#pragma once

#include "quadrel/relief/surface/rabbid.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

struct H2nSobelPublished : RabbidNormal {
    static constexpr StageText text{"h2n-sobel@published", "surface", "normal from nine taps",
                                    "Rabbid76, Normal, Parallax and Relief mapping"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const vec2<F> texel_offset = TexelSize<F>(map).step;
        const auto context = io.template context<TextureSlot::height>();
        F hx[9];
        for (int i = 0; i < 9; ++i) {
            const vec2<F> step(F(static_cast<float>(i % 3 - 1)), F(static_cast<float>(i / 3 - 1)));
            hx[i] = texture(map, context, uv + texel_offset * step, io.frame().derivatives).x;
        }
        const vec2<F> delta(hx[0] - hx[2] + F(2) * (hx[3] - hx[5]) + hx[6] - hx[8],
                            hx[0] - hx[6] + F(2) * (hx[1] - hx[7]) + hx[2] - hx[8]);
        store_rabbid_normal(io, delta, texel_offset);
    }
};

}  // namespace quadrel
