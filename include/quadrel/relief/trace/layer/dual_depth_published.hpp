// dual-depth@published: the search of ET:Legacy's second renderer with RM_DOUBLEDEPTH, as listed.
//
// Source: ET:Legacy (after R. Beckebans, XreaL), renderer2/glsl/lib/reliefMapping_fp.glsl at
// 63e2127f, function RayIntersectDisplaceMap. The map holds the front depth in alpha and the back
// depth in blue ("swizzle": "rggr" of a map of front and back). The vector is that of its callers,
// S = V.xy * -u_DepthScale / V.z of the unit vector V to the viewer along tangent, binormal and
// normal; u_DepthScale is r_parallaxDepthScale, 0.03. Kept:
//   * the linear search asks for the front depth alone, so that a ray behind the back stops there;
//   * the back depth is asked for by the second of two nested tests of the refinement: depth and
//     best depth go back only where both hold, else depth walks on by half steps;
//   * no early exit, and best depths beyond 0.996 count as none;
//   * a ray that meets nothing is at the bottom (here: FLOOR, no miss).
// Look-ups take implicit derivatives, as texture2D does. 16 and 6 steps are parameters here. The
// relief's depth and seat move hit.depth alone.
#pragma once

#include "quadrel/relief/trace/layer/layers.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct DualDepthPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"dual-depth@published", "trace",
                                    "ET:Legacy's nested test of front and back depth as listed",
                                    "ET:Legacy, reliefMapping_fp.glsl, RM_DOUBLEDEPTH"};
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);
    static constexpr const char* not_reproduced =
        "tangents that two-sided surfaces turn towards the viewer: the frame's are taken";
    struct Params {
        std::int32_t steps = 16, binary_steps = 6;
        float scale = 0.03f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, most_steps, 16),
        parameter<&Params::binary_steps>("binary_steps", "1", "half steps", 0, 60, 6),
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.03)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> V = normalize(tangent_viewer(io));
        const vec2<F> S = vec2<F>(V) * F(-params.scale) / V.z;
        Int<F> fetches(0);
        Mask<F> met_nan(false);
        const auto depths = [&](F depth) {
            const vec2<F> uv = ray.uv + S * depth;
            const auto context = io.template context<TextureSlot::layers>(ray.active);
            const vec4<F> t = texture(layer_map(io), context, uv, io.frame().derivatives);
            io.march_step(ray.active, depth, uv, F(1) - depth, F(1) - t.w);
            count_in<F>(fetches, ray.active);
            return t;
        };
        F size = F(1) / number<F>(params.steps), depth(0), best(1);
        for (const auto k : steps<F>(1, params.steps - 1)) {
            depth = depth + size;
            const vec4<F> t = depths(depth);
            met_nan = met_nan | (ray.active & is_nan(t.w));
            best = select((best > F(0.996f)) & (depth >= t.w), depth, best);
        }
        const Mask<F> found = best < F(1);
        depth = best;
        for (const auto k : steps<F>(1, params.binary_steps)) {
            size = size * F(0.5f);
            const vec4<F> t = depths(depth);
            met_nan = met_nan | (ray.active & is_nan(t.w + t.z));
            const Mask<F> inside = (depth >= t.w) & (depth <= t.z);
            best = select(inside, depth, best);
            depth = select(inside, depth - F(2) * size, depth);
            depth = depth + size;
        }
        SearchResult<F> result;
        result.s = best;
        result.h = F(1) - best;
        result.status = search_status<F>(found, met_nan | !is_finite(S.x + S.y));
        result.steps = result.fetches = fetches;
        store_search(io, ray, result, ray.uv + S * best);
    }
};

}  // namespace quadrel
