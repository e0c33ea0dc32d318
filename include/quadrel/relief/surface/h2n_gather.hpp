// h2n-gather: differences of the four texels of the bilinear footprint, one gather.
//
// Corrects h2n-gather@published: the two differences of each axis are averaged (the listing adds
// them, slopes twice too steep), and go through J. The slopes are those at the middle of the four
// texels: constant over a cell, up to half a texel from the hit. Level 0 of the map, unfiltered.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct H2nGather : NormalFromTexels {
    static constexpr StageText text{"h2n-gather", "surface", "normal from the 2x2 texels around",
                                    "correction of h2n-gather@published"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        store_relief_normal(io, [&] {
            const SampledTexture& map = height_map(io);
            const vec2<F> uv = io.template load<Value::hit_uv>();
            // x: left, larger v;  y: right, larger v;  z: right, smaller v;  w: left, smaller v.
            const vec4<F> h = texture_gather(map, io.template context<TextureSlot::height>(), uv);
            const vec2<F> rise((h.z - h.w) + (h.y - h.x), (h.x - h.w) + (h.y - h.z));
            return rise * TexelSize<F>(map).texels * F(0.5f);
        });
    }
};

}  // namespace quadrel
