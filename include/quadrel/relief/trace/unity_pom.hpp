// unity-pom: the parallax occlusion mapping of Unity's shader graphs, as its shader has it.
//
// Source: Unity Technologies, Graphics repository, ParallaxOcclusionMapping in
// com.unity.render-pipelines.core/ShaderLibrary/PerPixelDisplacement.hlsl at c8df1d81; its view
// vector and height range as ParallaxOcclusionMappingNode.cs at 23843fc3 hands them over, for a
// tiling and an object scale of 1. (Its amplitude times 0.01 is `scale`. HDRP's Lit shader calls
// the same function with 5 to 15 steps by the angle.) Kept:
//   * the ray's height and the offset are accumulated, and the first point that is tested lies one
//     step in; a strict comparison; without a hit the last look-up is one step below the bottom;
//   * at most 3 times regula falsi, until ray and height are within 0.01 of the range; the interval
//     keeps the end whose side did not change, however far away, and the coordinate is that of the
//     last look-up, not of the crossing that would follow from it;
//   * all look-ups at level `lod`, to which the sampler's bias is added; beyond lod_threshold the
//     offset, not the depth, shrinks to nothing within one level;
//   * nothing holds the offset back along the surface, and seen from behind it runs the other way.
// hit.s is that of the last crossing, hit.h its outHeight. The relief's depth and seat move
// hit.depth alone. (The shader flips no axis: its bitangent is taken to run along growing v.)
#pragma once

#include "quadrel/relief/trace/counted_heights.hpp"
#include "quadrel/relief/trace/tangent_viewer.hpp"

namespace quadrel {

struct UnityPom : StageDefaults {
    static constexpr StageText text{"unity-pom", "trace",
                                    "Unity's parallax occlusion mapping, Shader Graph and HDRP",
                                    "Unity Technologies, PerPixelDisplacement.hlsl"};
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    struct Params {
        std::int32_t steps = 5;
        float scale = 0.01f, lod = 0, lod_threshold = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the height range", 1, 256, 5),
        parameter<&Params::scale>("scale", "UV", "UV length of the height range", -16, 16, 0.01),
        parameter<&Params::lod>("lod", "levels", "level of detail of all look-ups", 0, 17, 0),
        parameter<&Params::lod_threshold>("lod_threshold", "levels",
                                          "level beyond which the offset shrinks", 0, 17, 0)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights_of_level(io, F(params.lod));
        CountedHeights look_up(io, heights);
        Interval<F> interval(tangent_viewer(io), params);
        interval.march(look_up, ray, params.steps);
        interval.refine(look_up, ray);
        const F kept = F(1) - saturate(F(params.lod) - F(params.lod_threshold));
        const vec2<F> uv = ray.uv + interval.offset * kept;
        store_search(io, ray, look_up.result(interval.depth, uv, interval.found), uv);
    }

  private:
    /// The variables of the shader.
    template <Number F>
    struct Interval {
        F steps, step;
        vec2<F> offset_a_step, offset = vec2<F>(F(0));
        F ray_height, height = F(0), previous = F(0), depth = F(0);
        Mask<F> found = Mask<F>(false);

        Interval(const vec3<F>& V, const Params& params)
            : steps(static_cast<Scalar<F>>(params.steps)), step(F(1) / steps) {
            const F range(params.scale);
            const vec3<F> view = normalize(vec3<F>(V.x * range, V.y * range, V.z));
            offset_a_step = vec2<F>(view) / -view.z * step;
            ray_height = F(1) - step;
        }

        template <class LookUp>
        void march(LookUp& look_up, const SearchRay<F>& ray, int n) {
            Mask<F> active = ray.active;
            previous = look_up(active, F(0), ray.uv + offset);
            offset = offset + offset_a_step;
            height = look_up(active, F(1) - ray_height, ray.uv + offset);
            for (int i = 0; i < n; ++i) {
                const Mask<F> hit = active & (height > ray_height);
                found = found | hit;
                active = active & !hit;
                if (!any(active)) break;
                previous = select(active, height, previous);
                ray_height = select(active, ray_height - step, ray_height);
                offset = select(active, offset + offset_a_step, offset);
                height =
                    select(active, look_up(active, F(1) - ray_height, ray.uv + offset), height);
            }
        }

        template <class LookUp>
        void refine(LookUp& look_up, const SearchRay<F>& ray) {
            F above = ray_height + step, below = ray_height;
            F delta_above = above - previous, delta_below = below - height;
            Mask<F> active = ray.active;
            for (int i = 0; i < 3; ++i) {
                const F crossing =
                    (above * delta_below - below * delta_above) / (delta_below - delta_above);
                depth = select(active, F(1) - crossing, depth);
                offset = select(active, offset_a_step * (F(1) - crossing) * steps, offset);
                const F delta = crossing - look_up(active, depth, ray.uv + offset);
                active = active & !(abs(delta) <= F(0.01f));
                if (!any(active)) break;
                const Mask<F> under = delta < F(0);
                delta_below = select(under, delta, delta_below);
                below = select(under, crossing, below);
                delta_above = select(under, delta_above, delta);
                above = select(under, above, crossing);
            }
        }
    };
};

}  // namespace quadrel
