// offset-limit: parallax mapping whose shift stays below the relief's depth at grazing angles.
//
// Corrects offset-limit@published: the shift is (sigma - h) K r, that is, along the frame's K
// without its division by the depth rate r, so that it is right for any UV map, and the polygon's
// height is the material's seat. The shift is at most |sigma - h| times the depth in UV units.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"

namespace quadrel {

struct OffsetLimit : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"offset-limit", "trace",
                                    "shift by the height at the start, not divided by N.V",
                                    "correction of offset-limit@published; Welsh 2004, 4.3"};
    static constexpr auto inputs = search_inputs_and(Value::r);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F h = height_at_start(io, ray);
        store_search(io, ray, offset_result(ray, h),
                     shifted_uv(ray, h, io.template load<Value::r>()));
    }
};

}  // namespace quadrel
