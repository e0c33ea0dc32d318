// h2n-sobel: Sobel's operator over the eight neighbours a texel away.
//
// Corrects h2n-sobel@published: divided by 8 (the listing's slopes are eight times too steep), and
// through J. Central differences smoothed across by 1 2 1: exact for heights of second order, less
// noisy and blunter than h2n-4tap. Heights are fetched with the gradients of the undisplaced UV.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct H2nSobel : NormalFromTexels {
    static constexpr StageText text{"h2n-sobel", "surface", "normal from Sobel's 3x3 operator",
                                    "correction of h2n-sobel@published"};

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
            const F nw = h(-1, -1), n = h(0, -1), ne = h(1, -1), w = h(-1, 0), e = h(1, 0);
            const F sw = h(-1, 1), s = h(0, 1), se = h(1, 1);
            const F rise_u = (ne - nw) + (e - w) * F(2) + (se - sw);
            const F rise_v = (sw - nw) + (s - n) * F(2) + (se - ne);
            return vec2<F>(rise_u, rise_v) * size.texels * F(0.125f);
        });
    }
};

}  // namespace quadrel
