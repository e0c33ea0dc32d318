// playcanvas: the height map of PlayCanvas' standard material, as its shader has it.
//
// Source: PlayCanvas, engine repository, src/scene/shader-lib/glsl/chunks/standard/frag/parallax.js
// in the form of engine 2.22 that has parallaxMode and heightMapBase. `mode` offset: an offset by
// the height, not divided by the view vector's z. `mode` occlusion: a march and 5 half steps.
// (Forms before it: 2.22 betas have the base fixed at 0.5; 1.57 to 1.63 divide by z + 0.42 and have
// v the wrong way round.) The range is 0.1 times the factor, a UV length. Kept:
//   * the ray enters the top of the volume behind the fragment, which lies at height `base`; its
//     slope is limited to 5, so that the ray then is not the view ray;
//   * the shader computes the level of detail itself, from the undisplaced UV, whatever the form
//     that the sampler has for it;
//   * a step covers two texels of that level, from 1 to `samples` of them; their number is real,
//     and the last may end below the bottom plane: depths are clamped;
//   * half steps are made wherever the march ended below the surface, and a ray that starts there
//     stays at the top. Without a crossing FLOOR;
//   * rays that cross fewer than 3 texels fade to no offset at 1: then no look-up is made, and the
//     hit is the fragment, HIT.
// hit.s is the shader's hitBelowTop, before it fades, hit.h the last look-up's. The relief's depth
// and seat move hit.depth alone. The engine negates y because its bitangent points up the picture;
// the one here runs along growing v. Not reproduced: the engine's frame, normalised a fragment, or
// made of derivatives for meshes without tangents; the global textureBias of the offset's look-up
// (its look-ups take implicit derivatives); self-shadows.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct PlayCanvas : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"playcanvas", "trace",
                                    "PlayCanvas' height map, offset or occlusion",
                                    "PlayCanvas 2.22, shader chunk parallax.js"};
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (normalised a fragment, or from derivatives); parallel "
        "projections, where its view vector still comes from the camera's place; the global "
        "textureBias of the offset's look-up; self-shadows";
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t mode = 0, samples = 16;
        float height_map_factor = 1, base = 0.5f;
    };
    static constexpr ValueName mode_names[] = {{0, "offset"}, {1, "occlusion"}};
    static constexpr std::array parameters{
        choice<&Params::mode>("mode", "parallaxMode; occlusion is a search", mode_names, 0),
        parameter<&Params::samples>("samples", "1", "most steps of occlusion", 1, most_steps, 16),
        parameter<&Params::height_map_factor>(
            "height_map_factor", "0.1 UV", "UV length of the height range, times 10", -160, 160, 1),
        parameter<&Params::base>("base", "1", "height that does not move", 0, 1, 0.5)};
    static constexpr bool uses_height_bounds = true;
    /// A step covers two texels: bounds of parts of the map, which need many, are of no use.
    static std::int32_t lattice_steps(const Params& params) { return params.mode != 0 ? 1 : 0; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view = normalize(tangent_viewer(io));
        const F scale(static_cast<Scalar<F>>(0.1 * double(params.height_map_factor)));
        if (params.mode) {
            search(io, ray, Volume<F>(io, ray, view, scale, params), params);
            return;
        }
        const F texel = implicit_height_at_start(io, ray);
        const F height = (texel - F(params.base)) * scale;
        store_search(io, ray, offset_result(ray, texel), ray.uv + vec2<F>(view) * height);
    }

  private:
    /// What the shader knows of the ray before its first look-up.
    template <Number F>
    struct Volume {
        vec2<F> span, entry;
        F plane_depth, level, fade, steps;

        template <class Io>
        Volume(const Io& io, const SearchRay<F>& ray, const vec3<F>& view, F scale,
               const Params& params) {
            const vec2<F> march = vec2<F>(view) * -scale / max(view.z, F(0.0001f));
            const F march_length = length(march), longest = scale * F(5);
            span = select(march_length > longest, march * (longest / march_length), march);
            plane_depth = F(1) - F(params.base);
            entry = ray.uv - span * plane_depth;
            const vec2<F> size = TexelSize<F>(height_map(io)).texels;
            const vec2<F> dx = dFdx(ray.uv * size, io.frame().derivatives);
            const vec2<F> dy = dFdy(ray.uv * size, io.frame().derivatives);
            level = max(F(0), F(0.5f) * log2(max(dot(dx, dx), dot(dy, dy))));
            const F texels = length(span * size) / exp2(level);
            fade = clamp((texels - F(1)) / F(2), F(0), F(1));
            steps = clamp(texels / F(2), F(1), F(static_cast<Scalar<F>>(params.samples)));
        }
    };

    /// Depths of the ray and of the surface below it.
    template <Number F>
    struct March {
        F ray = F(0), previous = F(0), surface = F(0);
    };

    template <class Io, class F = typename Io::Number>
    static void search(const Io& io, const SearchRay<F>& ray, const Volume<F>& volume,
                       const Params& params) {
        const auto heights = settled_heights_of_level(io, volume.level);
        CountedHeights look_up(io, heights);
        const Mask<F> searches = ray.active & (volume.fade > F(0));
        const March<F> march = descend(look_up, searches, volume, params.samples);
        const Mask<F> crosses = searches & (march.ray >= march.surface);
        const F depth = clamp(halve(look_up, crosses, volume, march), F(0), F(1));
        const vec2<F> moved = ray.uv + volume.span * ((depth - volume.plane_depth) * volume.fade);
        const F s = select(searches, depth, F(ray.s_polygon));
        const vec2<F> uv = select(searches, moved, ray.uv);
        store_search(io, ray, look_up.result(s, uv, crosses | !searches), uv);
    }

    template <class LookUp, class F>
    static March<F> descend(LookUp& look_up, Mask<F> active, const Volume<F>& volume, int most) {
        March<F> march;
        const F step = F(1) / volume.steps;
        march.surface = F(1) - look_up(active, F(0), volume.entry);
        active = active & !(march.ray >= march.surface);
        const auto next = [&](F from) { return from + step; };
        const Course course{[&](F from) { return volume.entry + volume.span * next(from); },
                            [&](F from, F height) { return !(next(from) >= F(1) - height); }, next};
        for (const auto i : steps_on_course<F>(course, march.ray, look_up.heights(), active, 0,
                                               most - 1, ceil(volume.steps) - F(1))) {
            active = active & (number<F>(i) < volume.steps);
            if (none(active)) break;
            march.previous = select(active, march.ray, march.previous);
            march.ray = select(active, next(march.ray), march.ray);
            const F height = look_up(active, march.ray, volume.entry + volume.span * march.ray);
            march.surface = select(active, F(1) - height, march.surface);
            active = active & !(march.ray >= march.surface);
        }
        return march;
    }

    /// The depth of the hit.
    template <class LookUp, class F>
    static F halve(LookUp& look_up, Mask<F> crosses, const Volume<F>& volume,
                   const March<F>& march) {
        F interval = (march.ray - march.previous) * F(0.5f), hit = march.ray - interval;
        for (const auto k : steps<F>(1, 5)) {
            if (none(crosses)) break;
            interval = interval * F(0.5f);
            const F surface = F(1) - look_up(crosses, hit, volume.entry + volume.span * hit);
            hit = hit + select(hit >= surface, -interval, interval);
        }
        return select(crosses, hit, march.ray);
    }
};

}  // namespace quadrel
