// relaxed-cone@published: 15 steps along relaxed cones and 8 signed halvings of the whole way.
//
// Source: F. Policarpo, M. M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// 2007, chapter 18, program on the disc, relief_mapping.fx: the ray v = K (per unit of depth),
// depth = 1 - height, cone steps v * (c * g / (|v| + c)) with the gap g saturated; then v is set to
// half of the way down and halved before every signed step. Kept as listed: fixed numbers of steps,
// so that grazing rays end before the surface; straight rays over a cone of ratio 0 divide 0 by 0.
// Not reproduced: the 8 bits of its map; its depth bias and border clamp, both off by default.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

struct RelaxedConePublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"relaxed-cone@published", "trace",
                                    "15 relaxed cone steps, 8 halvings",
                                    "Policarpo and Oliveira 2007, GPU Gems 3, chapter 18, disc"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the 8 bits of its map; depth bias and border clamp, off by default";
    static constexpr auto textures = slots(TextureSlot::relaxed_cone);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto look = cone_look_up<TextureSlot::relaxed_cone>(io);
        vec2<F> p = ray.uv, v = ray.K;
        F depth(0), v_z(1);
        const F dist = length(v);
        F height(0);
        for (const auto k : steps<F>(1, 15)) {
            const Cone<F> t = look(ray.active, depth, p);
            height = t.height;
            const F gap = saturate((F(1) - t.height) - depth);
            const F factor = t.ratio * gap / (dist + t.ratio);
            p = p + v * factor;
            depth = depth + v_z * factor;
        }
        v = v * (depth * F(0.5f));
        v_z = v_z * (depth * F(0.5f));
        p = ray.uv + v;
        depth = v_z;
        for (const auto k : steps<F>(1, 8)) {
            const Cone<F> t = look(ray.active, depth, p);
            height = t.height;
            v = v * F(0.5f);
            v_z = v_z * F(0.5f);
            const Mask<F> above = depth < F(1) - t.height;
            p = select(above, p + v, p - v);
            depth = select(above, depth + v_z, depth - v_z);
        }
        SearchResult<F> result;
        result.s = depth;
        result.h = height;
        result.status =
            select(is_nan(height), status_packet<F>(Status::nan), status_packet<F>(Status::hit));
        result.steps = result.fetches = select(ray.active, Int<F>(23), Int<F>(0));
        store_search(io, ray, result, p);
    }
};

}  // namespace quadrel
