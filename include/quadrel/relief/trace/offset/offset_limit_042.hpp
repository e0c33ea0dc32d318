// offset-limit-042: the limited offset of Unity's built-in shaders, which divide by N.V + 0.42.
//
// Source: Unity, built-in shaders, UnityCG.cginc, ParallaxOffset: v.z += 0.42; uv += height *
// (v.xy / v.z). Differs: the shift is along the frame's K, so that it is right for any UV map (K r
// is what the source calls v.xy), and the polygon's height is the material's seat, where the source
// has one half.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"

namespace quadrel {

struct OffsetLimit042 : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"offset-limit-042", "trace",
                                    "shift by the height at the start, divided by N.V + 0.42",
                                    "Unity, UnityCG.cginc, ParallaxOffset"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        float added = 0.42f;
    };
    static constexpr std::array parameters{parameter<&Params::added>(
        "added", "1", "added to the depth rate before the division", 0, 16, 0.42)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F h = height_at_start(io, ray);
        const F r = io.template load<Value::r>();
        store_search(io, ray, offset_result(ray, h), shifted_uv(ray, h, r / (r + F(params.added))));
    }
};

}  // namespace quadrel
