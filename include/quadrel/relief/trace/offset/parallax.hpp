// parallax: shift to where the view ray would meet a surface as flat and high as the start.
//
// Source: Kaneko et al., "Detailed Shape Representation with Parallax Mapping", ICAT 2001.
//     uv' = uv + (sigma - h(uv)) K,  sigma the height at which the polygon lies.
// Exact where the height is constant. No occlusion; the shift grows without bound towards grazing
// angles.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"

namespace quadrel {

struct Parallax : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"parallax", "trace", "shift by the height at the start",
                                    "Kaneko et al. 2001"};
    static constexpr auto inputs = search_inputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        store_search(io, ray, offset_result(ray, height_at_start(io, ray)));
    }
};

}  // namespace quadrel
