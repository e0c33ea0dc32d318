// h2n-4tap: central differences over the four neighbours a texel away.
//
// Corrects h2n-4tap@published: the differences are halved (the listing's slopes are twice too
// steep) and go through J (the listing's frame forgets the size of a tile, and turns the
// anisotropy of a map around). Exact for heights of second order; wider than a texel's own detail.
// Heights are fetched with the gradients of the undisplaced UV, always one texel of level 0 apart.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct H2n4Tap : NormalFromTexels {
    static constexpr StageText text{"h2n-4tap", "surface", "normal from central differences",
                                    "correction of h2n-4tap@published"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        store_relief_normal(io, [&] {
            const TexelSize<F> size(height_map(io));
            const auto heights = march_heights(io);
            const vec2<F> uv = io.template load<Value::hit_uv>();
            const auto h = [&](float i, float j) {
                return heights(io.active(), uv + size.step * vec2<F>(F(i), F(j)));
            };
            const vec2<F> rise(h(1, 0) - h(-1, 0), h(0, 1) - h(0, -1));
            return rise * size.texels * F(0.5f);
        });
    }
};

}  // namespace quadrel
