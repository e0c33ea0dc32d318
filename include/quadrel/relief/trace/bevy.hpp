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

#include "quadrel/relief/trace/search.hpp"
#include "quadrel/relief/trace/step_count.hpp"
#include "quadrel/relief/trace/tangent_viewer.hpp"

namespace quadrel {

struct Bevy : StageDefaults {
    static constexpr StageText text{"bevy", "trace", "Bevy's depth map, occlusion or relief",
                                    "Bevy, bevy_pbr/src/render/parallax_mapping.wesl"};
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (normal and tangents interpolated and not normalised); the UV "
        "transform and a second UV set";
    static constexpr auto textures = slots(TextureSlot::height);
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

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        March<F> march(ray, -tangent_viewer(io), params);
        SearchResult<F> result;
        Mask<F> found(true);
        if (params.max_layers >= 1) {
            const auto heights = march_heights_of_level(io, F(0));
            march.descend(io, heights);
            found = !(march.texture_depth > march.current_layer_depth);
            if (params.relief) {
                march.half_steps(io, heights, params.relief_steps);
            } else {
                march.secant(io, heights);
            }
            result.s = march.current_layer_depth;
        } else {
            result.s = F(ray.s_polygon);
        }
        result.h = march.h;
        const vec2<F> uv = march.uv;
        result.status =
            search_status<F>(found, march.met_nan | !is_finite(uv.x + uv.y), Status::floor);
        result.steps = march.fetches;
        result.fetches = march.fetches;
        store_search(io, ray, result, uv);
    }

  private:
    /// The shader's variables, named as there.
    template <Number F>
    struct March {
        Mask<F> searches;
        vec2<F> uv, delta_uv;
        F layer_count, layer_depth, current_layer_depth = F(0), texture_depth = F(0), h = F(0);
        Mask<F> met_nan = Mask<F>(false);
        Int<F> fetches = Int<F>(0);

        March(const SearchRay<F>& ray, const vec3<F>& Vt, const Params& params)
            : searches(ray.active), uv(ray.uv) {
            const F view_steepness = abs(Vt.z);
            layer_count = mix(F(params.max_layers), F(1), view_steepness);
            layer_depth = F(1) / layer_count;
            delta_uv = vec2<F>(Vt) * (F(params.scale) * layer_depth) / view_steepness;
        }

        /// One look-up at `at`, a depth of `s`, in the lanes of `active`: their height.
        template <class Io, class Heights>
        F look_up(const Io& io, const Heights& heights, Mask<F> active, F s, const vec2<F>& at) {
            const F height = heights(active, at);
            io.march_step(active, s, at, F(1) - s, height);
            met_nan = met_nan | (active & is_nan(height));
            count_in<F>(fetches, active);
            return height;
        }
        template <class Io, class Heights>
        void sample(const Io& io, const Heights& heights, Mask<F> active) {
            const F height = look_up(io, heights, active, current_layer_depth, uv);
            h = select(active, height, h);
            texture_depth = select(active, F(1) - height, texture_depth);
        }
        void move(Mask<F> active, const vec2<F>& by, F deeper) {
            uv = select(active, uv + by, uv);
            current_layer_depth = select(active, current_layer_depth + deeper, current_layer_depth);
        }

        template <class Io, class Heights>
        void descend(const Io& io, const Heights& heights) {
            Mask<F> active = searches;
            for (int i = 0; i <= most_steps + 1; ++i) {
                sample(io, heights, active);
                active = active & (texture_depth > current_layer_depth) &
                         (F(static_cast<Scalar<F>>(i)) <= trunc(layer_count));
                if (!any(active)) break;
                move(active, delta_uv, layer_depth);
            }
        }
        template <class Io, class Heights>
        void half_steps(const Io& io, const Heights& heights, int steps) {
            vec2<F> delta = delta_uv * F(0.5f);
            F delta_depth = layer_depth * F(0.5f);
            move(searches, -delta, -delta_depth);
            for (int i = 0; i < steps; ++i) {
                sample(io, heights, searches);
                delta = delta * F(0.5f);
                delta_depth = delta_depth * F(0.5f);
                const Mask<F> above = texture_depth > current_layer_depth;
                move(searches, select(above, delta, -delta),
                     select(above, delta_depth, -delta_depth));
            }
        }
        template <class Io, class Heights>
        void secant(const Io& io, const Heights& heights) {
            const vec2<F> previous_uv = uv - delta_uv;
            const F next_depth = texture_depth - current_layer_depth;
            const F s = current_layer_depth - layer_depth;
            const F height = look_up(io, heights, searches, s, previous_uv);
            const F previous_depth = (F(1) - height) - current_layer_depth + layer_depth;
            const F weight = next_depth / (next_depth - previous_depth);
            uv = mix(uv, previous_uv, weight);
            current_layer_depth = current_layer_depth + mix(next_depth, previous_depth, weight);
        }
    };
};

}  // namespace quadrel
