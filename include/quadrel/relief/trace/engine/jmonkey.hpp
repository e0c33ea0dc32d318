// jmonkey: the parallax of jMonkeyEngine's materials, classic and steep, as their shader has it.
//
// Source: jMonkeyEngine, jme3-core, Common/ShaderLib/Parallax.glsllib at 7277b5d8,
// classicParallaxOffset (`steep` 0) and steepParallaxOffset (`steep` 1, after ATI's of the DirectX
// SDK, pom-dxsdk), called as by PBR materials, module/pbrlighting/PBRLightingUtils.glsllib at
// 08582ac2. `scale` is the material's ParallaxHeight. Kept of the classic one:
//   * 0.6 of the range lies below the polygon, whatever the material wants;
//   * the offset is multiplied by the view vector's z where parallax divides by it: it shrinks
//     along the surface, and is longest at 45 degrees.
// Kept of the steep one:
//   * the range is 0.3 times the scale, so that switching between the two changes the depth;
//   * samples go from 6 seen from above to 300 times the scale along the surface, a real number,
//     and with scales below 0.02 fewer where most are needed; the last may lie below the bottom;
//   * the first sample is one step in, and the height before it is taken to be 0: the top of the
//     relief, met in the first step, sinks by up to a step;
//   * the test is strict, and what follows is computed without a hit too: the line through the last
//     two heights, on to wherever it meets the ray, FLOOR; if it runs along the ray, NAN;
//   * seen exactly along the normal, normalize(0) makes the coordinate NaN, and close to it the
//     rounding of a root's argument can: NAN;
//   * look-ups take implicit derivatives; nothing holds the offset back along the surface.
// hit.s is where that line meets the ray, hit.h the last look-up's height. The relief's depth and
// seat move hit.depth alone. (B runs along growing v in the engine too.)
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct JMonkey : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"jmonkey", "trace",
                                    "jMonkeyEngine's parallax, classic or steep",
                                    "jMonkeyEngine, Common/ShaderLib/Parallax.glsllib"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (its bitangent a cross product, back faces not turned); the vector of "
        "Phong materials (normalised once more; of eye space in one pass without a normal map); "
        "parallel projections, where its view vector still comes from the camera's place; "
        "negative heights";
    static constexpr auto textures = slots(TextureSlot::height);
    struct Params {
        std::int32_t steep = 0;
        float scale = 0.05f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steep>("steep", "0 or 1", "1: steep parallax, a search", 0, 1, 0),
        parameter<&Params::scale>(
            "scale", "UV", "UV length of the height range; 0.3 of it if steep", 0, 16, 0.05)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.steep != 0 ? static_cast<std::int32_t>(std::max(6.0f, 300 * params.scale))
                                 : 0;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view = tangent_viewer(io);
        const F scale(params.scale);
        if (params.steep) return search(io, ray, Steep<F>(ray, view, scale));
        const vec3<F> unit = normalize(view);
        const F texel = implicit_height_at_start(io, ray);
        const F height = (texel * scale + scale * F(-0.6f)) * unit.z;
        store_search(io, ray, offset_result(ray, texel), ray.uv + vec2<F>(unit) * height);
    }

  private:
    /// The ray's height and the map's, at the last sample and the one before.
    template <Number F>
    struct Steep {
        Mask<F> searches;
        vec3<F> at;  ///< the coordinate and the ray's height
        vec2<F> offset, offset_a_step;
        F samples, step, height = F(0), previous = F(1);

        Steep(const SearchRay<F>& ray, const vec3<F>& view, F scale)
            : searches(ray.active), at(ray.uv, F(1)) {
            const F range = scale * F(0.3f), distance = length(view);
            const F slope = sqrt(distance * distance - view.z * view.z) / view.z;
            offset = normalize(vec2<F>(view)) * slope * range;
            samples = mix(F(6), F(1000) * range, F(1) - normalize(view).z);
            step = F(1) / samples;
            offset_a_step = offset * step;
        }

        template <class LookUp>
        void descend(LookUp& look_up) {
            Mask<F> active = searches;
            const auto next = [&](const vec3<F>& from) {
                return from - vec3<F>(offset_a_step, step);
            };
            const Course course{
                [&](const vec3<F>& from) { return vec2<F>(select(active, next(from), from)); },
                [&](const vec3<F>& from, F found) { return found <= next(from).z; }, next};
            for (const auto i :
                 steps_on_course<F, Before::needed>(course, at, look_up.heights(), active, 0,
                                                    most_steps - 1, ceil(samples) - F(1))) {
                active = active & (number<F>(i) < samples);
                if (none(active)) break;
                at = select(active, next(at), at);
                previous = select(active, height, previous);
                height = select(active, look_up(active, F(1) - at.z, vec2<F>(at)), height);
                active = active & (height <= at.z);
            }
        }

        /// The height at which the line through the last two meets the ray.
        F meeting() const {
            const F bound = at.z, bound_before = bound + step;
            const F before = bound_before - previous, after = bound - height;
            return (bound * before - bound_before * after) / (before - after);
        }
    };

    template <class Io, class F>
    static void search(const Io& io, const SearchRay<F>& ray, Steep<F> march) {
        const ImplicitHeights heights(io);
        CountedHeights look_up(io, heights);
        march.descend(look_up);
        const F s = F(1) - march.meeting();
        const vec2<F> uv = ray.uv - march.offset * s;
        store_search(io, ray, look_up.result(s, uv, march.height > march.at.z), uv);
    }
};

}  // namespace quadrel
