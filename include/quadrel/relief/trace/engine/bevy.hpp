// bevy: the depth map of Bevy's standard material, as its shader has it.
//
// Source: Bevy, crates/bevy_pbr/src/render/parallax_mapping.wesl, parallaxed_uv, at 4805ca79
// (0.20.0-dev; parallax_mapping.wgsl of earlier versions computes the same). `relief` is its
// method: occlusion, steep parallax mapping and one secant, or relief, half steps back and forth
// from the middle of the last step. Its map holds depths, here 1 - height. Kept:
//   * the number of layers is real, mix(max, 1, |z|): one, seen from above; depth and coordinate
//     are accumulated. Fewer than one layer: no parallax, no look-up;
//   * at most trunc(n) + 1 steps: a surface that is deeper still is FLOOR;
//   * the offset is divided by |z|, however small: triangles seen from behind march as from the
//     front, and nothing bounds the offset along the surface;
//   * half steps are made even where the surface is at the top, and may end above it;
//   * all look-ups at level 0.
// hit.s is the shader's current_layer_depth, which it does not return: with the secant that of the
// sample before it, because what it adds there is 0 but for rounding. The secant of equal
// differences is no number: NAN. The relief's depth and seat move hit.depth alone. The engine
// negates y because its bitangent points up the picture; the one here runs along growing v. Not
// reproduced: the engine's frame (calculate_tbn_mikktspace), whose normal and tangents are
// interpolated and not normalised; the UV transform and the second UV set.
#pragma once

#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct Bevy : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"bevy", "trace", "Bevy's depth map, occlusion or relief",
                                    "Bevy, bevy_pbr/src/render/parallax_mapping.wesl"};
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (normal and tangents interpolated and not normalised); the UV "
        "transform and a second UV set";
    struct Params {
        std::int32_t relief = 0, relief_steps = 5;
        float max_layers = 16, scale = 0.1f;
    };
    static constexpr ValueName relief_names[] = {{0, "occlusion"}, {1, "relief"}};
    static constexpr std::array parameters{
        choice<&Params::relief>("relief", "occlusion: one secant; relief: half steps", relief_names,
                                0),
        parameter<&Params::relief_steps>("relief_steps", "1", "half steps, if relief", 0, 1024, 5),
        parameter<&Params::max_layers>(
            "max_layers", "1", "layers along the surface; below 1: no parallax", 0, most_steps, 16),
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.1)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return static_cast<std::int32_t>(params.max_layers);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto map = settled_heights_of_level(io, F(0));
        CountedHeights heights(io, map);
        March<F> march(ray, -tangent_viewer(io), params);
        if (params.max_layers < 1) {
            const F s(ray.s_polygon);
            return store_search(io, ray, heights.result(s, march.uv(), Mask<F>(true)), march.uv());
        }
        march.descend(heights);
        const Mask<F> found = !(march.texture_depth > march.current_layer_depth());
        if (params.relief) march.half_steps(heights, params.relief_steps);
        const F h = heights.last();
        if (!params.relief) march.secant(heights);
        SearchResult<F> result = heights.result(march.current_layer_depth(), march.uv(), found);
        result.h = h;
        store_search(io, ray, result, march.uv());
    }

  private:
    /// The shader's variables, named as there.
    template <Number F>
    struct March {
        Mask<F> searches;
        vec3<F> at;  ///< uv and current_layer_depth
        vec2<F> delta_uv;
        F layer_count, layer_depth, texture_depth = F(0);

        March(const SearchRay<F>& ray, const vec3<F>& Vt, const Params& params)
            : searches(ray.active), at(ray.uv, F(0)) {
            const F view_steepness = abs(Vt.z);
            layer_count = mix(F(params.max_layers), F(1), view_steepness);
            layer_depth = F(1) / layer_count;
            delta_uv = vec2<F>(Vt) * (F(params.scale) * layer_depth) / view_steepness;
        }

        vec2<F> uv() const { return vec2<F>(at); }
        F current_layer_depth() const { return at.z; }

        template <class Heights>
        void sample(Heights& heights, Mask<F> active) {
            const F height = heights(active, current_layer_depth(), uv());
            texture_depth = select(active, F(1) - height, texture_depth);
        }
        void move(Mask<F> active, const vec2<F>& by, F deeper) {
            at = select(active, at + vec3<F>(by, deeper), at);
        }

        template <class Heights>
        void descend(Heights& heights) {
            Mask<F> active = searches;
            const Course course{
                [](const vec3<F>& to) { return vec2<F>(to); },
                [](const vec3<F>& to, F height) { return F(1) - height > to.z; },
                [&](const vec3<F>& from) { return from + vec3<F>(delta_uv, layer_depth); }};
            const F layers = trunc(layer_count);
            for (const auto i : steps_on_course<F>(course, at, heights.heights(), active, 0,
                                                   most_steps + 1, layers + F(1))) {
                sample(heights, active);
                active =
                    active & (texture_depth > current_layer_depth()) & (number<F>(i) <= layers);
                if (none(active)) break;
                at = select(active, course.next(at), at);
            }
        }
        template <class Heights>
        void half_steps(Heights& heights, int times) {
            vec2<F> delta = delta_uv * F(0.5f);
            F delta_depth = layer_depth * F(0.5f);
            move(searches, -delta, -delta_depth);
            for (const auto k : steps<F>(1, times)) {
                sample(heights, searches);
                delta = delta * F(0.5f);
                delta_depth = delta_depth * F(0.5f);
                const Mask<F> above = texture_depth > current_layer_depth();
                move(searches, select(above, delta, -delta),
                     select(above, delta_depth, -delta_depth));
            }
        }
        template <class Heights>
        void secant(Heights& heights) {
            const vec2<F> previous_uv = uv() - delta_uv;
            const F next_depth = texture_depth - current_layer_depth();
            const F s = current_layer_depth() - layer_depth;
            const F height = heights(searches, s, previous_uv);
            const F previous_depth = (F(1) - height) - current_layer_depth() + layer_depth;
            const F weight = next_depth / (next_depth - previous_depth);
            const F moved = mix(next_depth, previous_depth, weight);
            at = vec3<F>(mix(uv(), previous_uv, weight), current_layer_depth() + moved);
        }
    };
};

}  // namespace quadrel
