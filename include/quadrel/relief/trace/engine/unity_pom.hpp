// unity-pom: the parallax occlusion mapping of Unity's shader graphs and of HDRP, as it is there.
//
// Source: Unity Technologies, Graphics repository, ParallaxOcclusionMapping in
// com.unity.render-pipelines.core/ShaderLibrary/PerPixelDisplacement.hlsl at c8df1d81. `mode`
// shader-graph: as ParallaxOcclusionMappingNode.cs at 23843fc3 calls it, `scale` its amplitude
// times 0.01, tiling and object scale 1. `mode` hdrp: as HDRP's Lit shader does,
// LitDataDisplacement.hlsl at d679af29, `scale` its amplitude over the primitive's size: `steps` to
// `max_steps` by an approximate arc cosine, and the level of detail that it computes from the
// undisplaced UV. (Its lod_threshold is 5.) Kept:
//   * the ray's height and the offset are accumulated, and the first point that is tested lies one
//     step in; a strict comparison; without a hit the last look-up is one step below the bottom;
//   * at most 3 times regula falsi, until ray and height are within 0.01 of the range; the interval
//     keeps the end whose side did not change, however far away, and the coordinate is that of the
//     last look-up, not of the crossing that would follow from it;
//   * all look-ups at one level, to which the sampler's bias is added; beyond lod_threshold the
//     offset, not the depth, shrinks to nothing within one level;
//   * the angle of HDRP is that of the view vector after scaling, hardly one for a shallow relief;
//   * nothing holds the offset back along the surface, and seen from behind it runs the other way.
// hit.s is that of the last crossing, hit.h its outHeight. The relief's depth and seat move
// hit.depth alone. (The shader flips no axis: its bitangent is taken to run along growing v.) Not
// reproduced: the engine's frame (HDRP's is not normalised), half precision where `real` is that,
// object scale, tiling, and triplanar maps.
#pragma once

#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct UnityPom : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"unity-pom", "trace",
                                    "Unity's parallax occlusion mapping, Shader Graph and HDRP",
                                    "Unity Technologies, PerPixelDisplacement.hlsl"};
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (not normalised in HDRP); half precision on mobile; object scale, "
        "tiling and triplanar maps";
    struct Params {
        std::int32_t mode = 0, steps = 5, max_steps = 15;
        float scale = 0.01f, lod = 0, lod_threshold = 0;
    };
    static constexpr ValueName mode_names[] = {{0, "shader-graph"}, {1, "hdrp"}};
    static constexpr std::array parameters{
        choice<&Params::mode>("mode", "whose: Shader Graph's node or HDRP", mode_names, 0),
        parameter<&Params::steps>("steps", "1", "steps; of HDRP those seen from above", 1, 256, 5),
        parameter<&Params::max_steps>("max_steps", "1", "steps along the surface, HDRP", 1, 256,
                                      15),
        parameter<&Params::scale>("scale", "UV", "UV length of the height range", -16, 16, 0.01),
        parameter<&Params::lod>("lod", "levels", "level of detail of Shader Graph", 0, 17, 0),
        parameter<&Params::lod_threshold>("lod_threshold", "levels",
                                          "level beyond which the offset shrinks", 0, 17, 0)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.mode != 0 ? std::max(params.steps, params.max_steps) : params.steps;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F range(params.scale);
        const vec3<F> V = tangent_viewer(io);
        const vec3<F> view = normalize(vec3<F>(V.x * range, V.y * range, V.z));
        F level(params.lod), steps(static_cast<Scalar<F>>(params.steps));
        if (params.mode) {
            level = own_level(io, ray.uv);
            steps = steps_by_view(view.z, steps, F(static_cast<Scalar<F>>(params.max_steps)));
        }
        const auto heights = settled_heights_of_level(io, level);
        CountedHeights look_up(io, heights);
        Interval<F> interval(view, steps);
        interval.march(look_up, ray);
        interval.refine(look_up, ray);
        const F kept = F(1) - saturate(level - F(params.lod_threshold));
        const vec2<F> uv = ray.uv + interval.offset() * kept;
        store_search(io, ray, look_up.result(interval.depth, uv, interval.found), uv);
    }

  private:
    /// ComputeTextureLOD.
    template <class Io, class F>
    static F own_level(const Io& io, const vec2<F>& uv) {
        const vec2<F> texels = uv * TexelSize<F>(height_map(io)).texels;
        const vec2<F> dx = dFdx(texels, io.frame().derivatives);
        const vec2<F> dy = dFdy(texels, io.frame().derivatives);
        return max(F(0.5f) * log2(max(dot(dx, dx), dot(dy, dy))), F(0));
    }
    /// By FastACosPos over half of pi.
    template <Number F>
    static F steps_by_view(F z, F fewest, F most) {
        const F x = abs(z);
        const F p = (F(0.0468878f) * x + F(-0.203471f)) * x + F(1.570796f);
        return trunc(lerp(fewest, most, saturate(p * sqrt(F(1) - x) * F(0.636619772367f))));
    }

    /// The variables of the shader.
    template <Number F>
    struct Interval {
        F num_steps, step;
        vec2<F> offset_a_step;
        vec3<F> at;  ///< the offset and the ray's height
        F height = F(0), previous = F(0), depth = F(0);
        Mask<F> found = Mask<F>(false);

        Interval(const vec3<F>& view, F n) : num_steps(n), step(F(1) / n) {
            offset_a_step = vec2<F>(view) / -view.z * step;
            at = vec3<F>(F(0), F(0), F(1) - step);
        }

        vec2<F> offset() const { return vec2<F>(at); }
        F ray_height() const { return at.z; }

        template <class LookUp>
        void march(LookUp& look_up, const SearchRay<F>& ray) {
            Mask<F> active = ray.active;
            previous = look_up(active, F(0), ray.uv + offset());
            at = at + vec3<F>(offset_a_step, F(0));
            const Course course{
                [&](const vec3<F>& to) { return ray.uv + vec2<F>(to); },
                [](const vec3<F>& to, F texel) { return !(texel > to.z); },
                [&](const vec3<F>& from) { return from + vec3<F>(offset_a_step, -step); }};
            for (const auto i : steps_on_course<F, Before::needed>(course, at, look_up.heights(),
                                                                   active, 0, 256, num_steps)) {
                const F texel = look_up(active, F(1) - ray_height(), course.at(at));
                height = select(active, texel, height);
                active = active & (number<F>(i) < num_steps);
                const Mask<F> hit = active & (height > ray_height());
                found = found | hit;
                active = active & !hit;
                if (none(active)) break;
                previous = select(active, height, previous);
                at = select(active, course.next(at), at);
            }
        }

        template <class LookUp>
        void refine(LookUp& look_up, const SearchRay<F>& ray) {
            F above = ray_height() + step, below = ray_height();
            F delta_above = above - previous, delta_below = below - height;
            Mask<F> active = ray.active;
            for (const auto i : steps<F>(1, 3)) {
                const F crossing =
                    (above * delta_below - below * delta_above) / (delta_below - delta_above);
                depth = select(active, F(1) - crossing, depth);
                const vec2<F> moved = offset_a_step * (F(1) - crossing) * num_steps;
                at = select(active, vec3<F>(moved, ray_height()), at);
                const F delta = crossing - look_up(active, depth, ray.uv + offset());
                active = active & !(abs(delta) <= F(0.01f));
                if (none(active)) break;
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
