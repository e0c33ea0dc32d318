// cone-gg3: the cone stepping of GPU Gems 3's demonstration, as listed.
//
// Source: F. Policarpo, M. M. Oliveira, GPU Gems 3, chapter 18, relief_mapping.fx, cone stepping:
// v = (V.xy * depth, |V.z|) of the unit view vector, here (K r, r); 15 steps of
// v * (c g / (|v.xy| + c)) with the gap g saturated. Kept: v is not divided by its z as in the
// relaxed variant, so that steps are shorter than the cone allows; a fixed number of steps; the end
// is never tested (CAP where it is more than 1/256 above the surface). A straight ray over a cone
// of ratio 0 divides 0 by 0.
// Not reproduced: the 8 bits of its map; its depth bias and border clamp, both off by default.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

struct ConeGg3 : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"cone-gg3", "trace", "15 cone steps as listed",
                                    "Policarpo and Oliveira 2007, GPU Gems 3, chapter 18, disc"};
    static constexpr auto inputs = values(Value::uv, Value::relief_depth, Value::r, Value::K,
                                          Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the 8 bits of its map; depth bias and border clamp, off by default";
    static constexpr auto textures = slots(TextureSlot::cone);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto look = cone_look_up<TextureSlot::cone>(io);
        const F v_z = io.template load<Value::r>();
        const vec2<F> v = ray.K * v_z;
        const F dist = length(v);
        vec2<F> p = ray.uv;
        F depth(0), height(0);
        for (const auto k : steps<F>(1, 15)) {
            const Cone<F> t = look(ray.active, depth, p);
            height = t.height;
            const F gap = saturate((F(1) - t.height) - depth);
            const F factor = t.ratio * gap / (dist + t.ratio);
            p = p + v * factor;
            depth = depth + v_z * factor;
        }
        SearchResult<F> result;
        result.s = depth;
        result.h = height;
        // Fifteen steps come near to the surface, and not on it: what counts as a hit is ours.
        const Mask<F> near = (F(1) - height) - depth <= F(1.0f / 256);
        result.status =
            select(is_nan(height), status_packet<F>(Status::nan),
                   select(near, status_packet<F>(Status::hit), status_packet<F>(Status::cap)));
        result.steps = result.fetches = select(ray.active, Int<F>(15), Int<F>(0));
        store_search(io, ray, result, p);
    }
};

}  // namespace quadrel
