// h2n-4tap@published: normal from four taps, as published.
//
// Source: "Normal, Parallax and Relief mapping" (Rabbid76, graphics-snippets), CalculateNormal, the
// version with four neighbours. Defects kept: differences over two texels are not halved: slopes
// twice too steep; implicit gradients of the displaced UV; the frame of rabbid.hpp.
#pragma once

#include "quadrel/relief/surface/rabbid.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

struct H2n4TapPublished : RabbidNormal {
    static constexpr StageText text{"h2n-4tap@published", "surface", "normal from four taps",
                                    "Rabbid76, Normal, Parallax and Relief mapping"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const vec2<F> texel_offset = TexelSize<F>(map).step;
        const auto context = io.template context<TextureSlot::height>();
        const auto h = [&](float i, float j) {
            return texture(map, context, uv + texel_offset * vec2<F>(F(i), F(j)),
                           io.frame().derivatives)
                .x;
        };
        const F h_xa = h(-1, 0), h_xb = h(1, 0), h_ya = h(0, -1), h_yb = h(0, 1);
        const vec2<F> delta(h_xa - h_xb, h_ya - h_yb);
        store_rabbid_normal(io, delta, texel_offset);
    }
};

}  // namespace quadrel
