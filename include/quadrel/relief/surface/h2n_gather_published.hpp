// h2n-gather@published: normal from one gather, as published.
//
// Source: "Normal, Parallax and Relief mapping" (Rabbid76, graphics-snippets), CalculateNormal, the
// version with textureGather. Defects kept: the two differences of an axis are added, not averaged:
// slopes twice too steep; the frame of rabbid.hpp.
#pragma once

#include "quadrel/relief/surface/rabbid.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

struct H2nGatherPublished : RabbidNormal {
    static constexpr StageText text{"h2n-gather@published", "surface", "normal from one gather",
                                    "Rabbid76, Normal, Parallax and Relief mapping"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const vec2<F> texel_offset = TexelSize<F>(map).step;
        const auto context = io.template context<TextureSlot::height>();
        const vec4<F> heights = texture_gather(map, context, uv);
        const vec2<F> delta(dot(heights, vec4<F>(F(1), F(-1), F(-1), F(1))),
                            dot(heights, vec4<F>(F(-1), F(-1), F(1), F(1))));
        store_rabbid_normal(io, delta, texel_offset);
    }
};

}  // namespace quadrel
