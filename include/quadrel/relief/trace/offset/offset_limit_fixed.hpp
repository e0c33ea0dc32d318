// offset-limit-fixed: parallax mapping until a fixed angle, limited beyond it.
//
// What many shaders do, without a canonical source: the divisor N.V is kept above a fixed least
// value, uv' = uv + (sigma - h) K r / max(r, r_min). Steeper views than that of r_min are exactly
// parallax; at grazing angles the shift is at most |sigma - h| / r_min depths in UV units.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"

namespace quadrel {

struct OffsetLimitFixed : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"offset-limit-fixed", "trace",
                                    "shift by the height at the start, its divisor bounded",
                                    "parallax (Kaneko et al. 2001) with N.V kept from 0"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        float r_min = 0.25f;
    };
    static constexpr std::array parameters{parameter<&Params::r_min>(
        "r_min", "1", "least divisor: cosine of the angle from which on the shift is limited",
        0x1p-20, 1, 0.25)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F h = height_at_start(io, ray);
        const F r = io.template load<Value::r>();
        store_search(io, ray, offset_result(ray, h),
                     shifted_uv(ray, h, r / max(r, F(params.r_min))));
    }
};

}  // namespace quadrel
