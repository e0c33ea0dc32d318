// three-parallax: the ParallaxShader of three.js' examples, as its shader has it.
//
// Source: three.js, examples/jsm/shaders/ParallaxShader.js at 05578ec7 (removed after r131), with
// the settings of examples/webgl_materials_parallaxmap.html. `mode` basic: an offset by the
// depth, not divided by z; occlusion: steep and one secant; relief: steep and 5
// half steps from the middle of the last step. Kept:
//   * the view vector is J V in the plane, its density kept, and N.V along the normal: the scale is
//     a world length, and nothing is normalised (here J is the frame's: frame-cot has the
//     shader's);
//   * the number of layers is real; depth and coordinate are accumulated;
//   * at most 30 layers, however many they are to be: with more, rays end above the bottom, FLOOR;
//   * the offset is divided by N.V, unlimited along the surface and of the other sign from behind;
//   * half steps are made even where the march found the surface at once, in front of it then;
//   * look-ups take implicit derivatives: in the loop, lanes that left keep their last coordinate;
//     those behind it are made by all lanes.
// The map holds depths, here 1 - height. (The example hands the shader -0.005: it reads its height
// map as depths and walks them towards the viewer.) hit.s and hit.h are those of the last half
// step, with the secant those of the sample before it; the relief's depth and seat move hit.depth
// alone.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ThreeParallax : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"three-parallax", "trace",
                                    "three.js' ParallaxShader: basic, steep, occlusion, relief",
                                    "three.js, examples/jsm/shaders/ParallaxShader.js"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::J, Value::frame_normal);
    static constexpr const char* not_reproduced =
        "the order of the sums that give J V (J is the frame's); parallel projections, where "
        "its view vector still comes from the camera's place";
    static constexpr bool needs_height_map = true;
    enum Mode : std::int32_t { basic, steep, occlusion, relief };
    struct Params {
        std::int32_t mode = relief, min_layers = 20, max_layers = 25;
        float scale = 0.005f;
    };
    static constexpr ValueName mode_names[] = {
        {basic, "basic"}, {steep, "steep"}, {occlusion, "occlusion"}, {relief, "relief"}};
    static constexpr std::array parameters{
        choice<&Params::mode>("mode", "the shader's parallax mode", mode_names, relief),
        parameter<&Params::min_layers>("min_layers", "1", "layers seen from above, unless basic", 1,
                                       most_steps, 20),
        parameter<&Params::max_layers>("max_layers", "1", "layers along the surface, unless basic",
                                       1, most_steps, 25),
        parameter<&Params::scale>("scale", "world unit", "depth of the relief", -16, 16, 0.005)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.mode != basic ? 30 : 0;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const ImplicitHeights heights(io);
        CountedHeights look_up(io, heights);
        const vec3<F> V = view(io);
        if (params.mode == basic) {
            const F height = look_up(ray.active, F(ray.s_polygon), ray.uv);
            const vec2<F> offset = vec2<F>(V) * F(params.scale) * (F(1) - height);
            store_search(io, ray, offset_result(ray, height), ray.uv - offset);
            return;
        }
        Layers<F> layers(ray, V, params);
        layers.march(look_up);
        if (params.mode == relief) layers.halve(look_up);
        const F height = look_up.last();
        if (params.mode == occlusion) layers.secant(look_up);
        SearchResult<F> result = look_up.result(layers.depth(), layers.uv(), layers.found);
        result.h = height;
        store_search(io, ray, result, layers.uv());
    }

  private:
    /// vProjVtex: the view vector in texture coordinates a world length, and along the normal.
    template <class Io, class F = typename Io::Number>
    static vec3<F> view(const Io& io) {
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        const auto J = io.template load<Value::J>();
        return {dot(J[0], V), dot(J[1], V), dot(io.template load<Value::frame_normal>(), V)};
    }

    template <Number F>
    struct Layers {
        Mask<F> searches, found = Mask<F>(false);
        vec3<F> at;  ///< the coordinate and the ray's depth
        vec2<F> shift;
        F layer, surface = F(0);

        Layers(const SearchRay<F>& ray, const vec3<F>& V, const Params& params)
            : searches(ray.active), at(ray.uv, F(0)) {
            const F layers = mix(F(static_cast<Scalar<F>>(params.max_layers)),
                                 F(static_cast<Scalar<F>>(params.min_layers)), abs(V.z));
            layer = F(1) / layers;
            shift = vec2<F>(V) * F(params.scale) / V.z / layers;
        }

        vec2<F> uv() const { return vec2<F>(at); }
        F depth() const { return at.z; }

        template <class LookUp>
        void sample(LookUp& look_up, Mask<F> active) {
            surface = select(active, F(1) - look_up(active, depth(), uv()), surface);
        }
        void move(Mask<F> active, const vec2<F>& by, F deeper) {
            at = select(active, at + vec3<F>(-by, deeper), at);
        }

        template <class LookUp>
        void march(LookUp& look_up) {
            constexpr int most_layers = 30;
            Mask<F> active = searches;
            const Course course{
                [](const vec3<F>& to) { return vec2<F>(to); },
                [](const vec3<F>& to, F height) { return !(F(1) - height <= to.z); },
                [&](const vec3<F>& from) { return from + vec3<F>(-shift, layer); }};
            for (const auto k :
                 steps_on_course<F>(course, at, look_up.heights(), active, 0, most_layers)) {
                sample(look_up, active);
                active = active & (number<F>(k) < number<F>(most_layers));
                const Mask<F> hit = active & (surface <= depth());
                found = found | hit;
                active = active & !hit;
                if (none(active)) break;
                at = select(active, course.next(at), at);
            }
        }
        template <class LookUp>
        void halve(LookUp& look_up) {
            vec2<F> half_shift = shift / F(2);
            F half_layer = layer / F(2);
            move(searches, -half_shift, -half_layer);
            for (const auto k : steps<F>(1, 5)) {
                half_shift = half_shift / F(2);
                half_layer = half_layer / F(2);
                sample(look_up, searches);
                const Mask<F> above = surface > depth();
                move(searches, select(above, half_shift, -half_shift),
                     select(above, half_layer, -half_layer));
            }
        }
        template <class LookUp>
        void secant(LookUp& look_up) {
            const vec2<F> previous = select(searches, uv() + shift, uv());
            const F next = surface - depth();
            const F height = look_up(searches, depth() - layer, previous);
            const F before = (F(1) - height) - depth() + layer;
            const F weight = next / (next - before);
            const vec2<F> meeting = previous * weight + uv() * (F(1) - weight);
            at = select(searches, vec3<F>(meeting, depth()), at);
        }
    };
};

}  // namespace quadrel
