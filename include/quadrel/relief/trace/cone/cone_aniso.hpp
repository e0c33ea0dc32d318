// cone-aniso: cone steps by ratios of eight sectors of azimuth.
//
// After Y.-C. Chen, C.-Y. Chuang, "Anisotropic Cone Mapping", APSIPA 2009, which could not be read:
// here a texel has one ratio for each sector of 45 degrees, and a ray takes that of the sector that
// its direction lies in. The guarantee of cone-step and its gaps.
#pragma once

#include "quadrel/relief/trace/cone/cone_step.hpp"

namespace quadrel {

/// Sector of 45 degrees, from +u towards +v in tiles, that a direction lies in: 0 to 7.
template <Number F>
Int<F> azimuth_sector(const vec2<F>& d) {
    const auto sector = [](std::int32_t k) { return Int<F>(k); };
    const Mask<F> right = d.x >= F(0), upper = d.y >= F(0), steep = abs(d.y) > abs(d.x);
    const Int<F> above =
        select(right, select(steep, sector(1), sector(0)), select(steep, sector(2), sector(3)));
    const Int<F> below =
        select(right, select(steep, sector(6), sector(7)), select(steep, sector(5), sector(4)));
    return select(upper, above, below);
}

struct ConeAniso : ConeSearch {
    static constexpr StageText text{"cone-aniso", "trace", "cone steps by ratios of eight sectors",
                                    "after Chen and Chuang 2009; sectors of azimuth"};
    static constexpr auto textures = slots(TextureSlot::cone, TextureSlot::aniso_cone);

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const Int<F> sector = azimuth_sector(ray.K);
        const Int<F> layer = select(sector >= Int<F>(4), Int<F>(1), Int<F>(0));
        const Int<F> channel = sector - layer * Int<F>(4);
        const auto heights = cone_look_up<TextureSlot::cone>(io);
        const BakedLookUp<TextureSlot::aniso_cone, 4, Io> ratios(io);
        const auto look = [&](Mask<F> active, F s, const vec2<F>& uv) {
            const F height = heights(active, s, uv).height;
            const Texel<4, F> of_sector = ratios(active, uv, layer);
            F ratio = of_sector.channel[0];
            for (int k = 1; k < 4; ++k)
                ratio = select(channel == Int<F>(k), of_sector.channel[k], ratio);
            return Cone<F>{height, ratio};
        };
        store_cone_steps(io, ray, look, params, 2);
    }
};

}  // namespace quadrel
