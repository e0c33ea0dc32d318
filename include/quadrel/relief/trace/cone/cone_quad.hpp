// cone-quad: cone steps by four ratios a texel, one for each side that a ray may go to.
//
// Source: F. Policarpo, M. M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// 2007, chapter 18, program on the disc (quad cone maps): the ratio is that of the axis along which
// the ray moves most, v where both are equal. As in cone-step, the listing's step is corrected and
// the number of steps is a parameter.
// The guarantee of cone-step and its gaps; a ray keeps to its sector, whose cone may be wider.
#pragma once

#include "quadrel/relief/trace/cone/cone_step.hpp"

namespace quadrel {

struct ConeQuad : ConeSearch {
    static constexpr StageText text{"cone-quad", "trace", "cone steps by ratios of four sides",
                                    "Policarpo and Oliveira 2007, GPU Gems 3, chapter 18, disc"};
    static constexpr auto textures = slots(TextureSlot::cone, TextureSlot::quad_cone);

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const Mask<F> along_u = abs(ray.K.x) > abs(ray.K.y);
        const auto heights = cone_look_up<TextureSlot::cone>(io);
        const BakedLookUp<TextureSlot::quad_cone, 4, Io> ratios(io);
        const auto look = [&](Mask<F> active, F s, const vec2<F>& uv) {
            const F height = heights(active, s, uv).height;
            const Texel<4, F> side = ratios(active, uv);
            const F u = select(ray.K.x < F(0), side.channel[0], side.channel[1]);
            const F v = select(ray.K.y < F(0), side.channel[2], side.channel[3]);
            return Cone<F>{height, select(along_u, u, v)};
        };
        store_cone_steps(io, ray, look, params, 2);
    }
};

}  // namespace quadrel
