// parallax-slope-nz and parallax-slope-nv: a limited offset, shorter where the surface is steep.
//
// Source: McGuire and McGuire, "Steep Parallax Mapping" (2005), who report a forum's suggestion to
// scale the limited offset by N.V, "to reduce swim where the gradient is large". There is no
// listing, and two readings, one row each: the map's normal times the surface's (n.z), and the
// map's normal times the view vector (n.V, negative ones taken as 0). map_normal.hpp says which
// normal. The shift is that of offset-limit, (sigma - h) K r, times the one or the other.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/map_normal.hpp"

namespace quadrel {

template <bool by_view>
struct ParallaxSlope : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text =
        by_view ? StageText{"parallax-slope-nv", "trace",
                            "limited offset scaled by the map's normal times the view vector",
                            "McGuire and McGuire 2005, related work"}
                : StageText{"parallax-slope-nz", "trace",
                            "limited offset scaled by the z of the map's normal",
                            "McGuire and McGuire 2005, related work"};
    static constexpr auto inputs = map_normal_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::normal);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F h = height_at_start(io, ray);
        const auto normal = map_normal(io, march_heights(io), ray.active, ray.uv);
        const Slope<F> steepness = slope(io, normal.n);
        const F factor = by_view ? max(steepness.nv, F(0)) : steepness.nz;
        auto result = offset_result(ray, h);
        result.status = search_status<F>(ray.active, is_nan(h) | is_nan(factor));
        count_normal(result.fetches, ray.active, normal);
        store_search(io, ray, result, shifted_uv(ray, h, io.template load<Value::r>() * factor));
    }
};

using ParallaxSlopeNz = ParallaxSlope<false>;
using ParallaxSlopeNv = ParallaxSlope<true>;

}  // namespace quadrel
