// godot: the height map of Godot Engine's standard material, as its shader has it.
//
// Source: Godot Engine, BaseMaterial3D, scene/resources/material.cpp, _update_shader, at 0059d788
// (4.x). `deep` 0: an offset by the depth, 1 - height. `deep` 1, "deep parallax": steep parallax
// mapping, then one secant. The scale is the material's: 1 is 0.01 in UV. Kept:
//   * neither mode divides by the view vector's z: the ray's slope is the sine of the angle of
//     view, not its tangent, and depths look too small along the surface;
//   * the number of layers is real; depth and coordinate are accumulated: the last sample may lie
//     below the bottom plane by a part of a layer;
//   * texture() in the loop takes implicit derivatives: lanes that left keep their last coordinate;
//     the look-up behind the loop is of all lanes, and of another level of detail than the same
//     point's in the loop;
//   * nothing bounds the loop (here: 65536 steps, CAP); a NaN height ends it, NAN; the secant of
//     equal differences is no number, NAN.
// hit.s and hit.h are those of the last sample before the secant, after which the shader has no
// depth. The relief's depth and seat move hit.depth alone. The engine's y axis is its bitangent
// negated, which points up the picture: along growing v, as the bitangent does here.
#pragma once

#include "quadrel/relief/trace/offset.hpp"
#include "quadrel/relief/trace/step_count.hpp"
#include "quadrel/relief/trace/tangent_viewer.hpp"

namespace quadrel {

struct Godot : StageDefaults {
    static constexpr StageText text{"godot", "trace", "Godot's height map, simple or deep",
                                    "Godot Engine, BaseMaterial3D, scene/resources/material.cpp"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t deep = 0, min_layers = 8, max_layers = 32;
        float scale = 5;
    };
    static constexpr std::array parameters{
        parameter<&Params::deep>("deep", "0 or 1", "1: deep parallax, a search", 0, 1, 0),
        parameter<&Params::min_layers>("min_layers", "1", "layers seen from above, if deep", 1, 64,
                                       8),
        parameter<&Params::max_layers>("max_layers", "1", "layers along the surface, if deep", 1,
                                       64, 32),
        parameter<&Params::scale>("scale", "0.01 UV", "UV length of the height range, times 100",
                                  -16, 16, 5)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view_dir = normalize(tangent_viewer(io));
        if (params.deep) {
            search(io, ray, view_dir, params);
            return;
        }
        const F height = look_up(io, ray.active, ray.uv);
        io.march_step(ray.active, F(ray.s_polygon), ray.uv, F(1) - F(ray.s_polygon), height);
        const vec2<F> offset = vec2<F>(view_dir) * (F(1) - height) * F(params.scale) * F(0.01f);
        store_search(io, ray, offset_result(ray, height), ray.uv - offset);
    }

  private:
    template <class Io, class F = typename Io::Number>
    static F look_up(const Io& io, Mask<F> active, const vec2<F>& uv) {
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const auto context = io.template context<TextureSlot::height>(active);
        return texture(map, context, uv, io.frame().derivatives).x;
    }

    /// The shader's variables, named as there.
    template <Number F>
    struct March {
        Mask<F> active;  ///< lanes still in the loop
        vec2<F> delta, ofs;
        F layer_depth, current_depth = F(0), depth = F(0);
        SearchResult<F> result{};
    };

    template <class Io, class F = typename Io::Number>
    static void search(const Io& io, const SearchRay<F>& ray, const vec3<F>& view_dir,
                       const Params& params) {
        const F num_layers = mix(F(static_cast<Scalar<F>>(params.max_layers)),
                                 F(static_cast<Scalar<F>>(params.min_layers)), abs(view_dir.z));
        const vec2<F> p = vec2<F>(view_dir) * F(params.scale) * F(0.01f);
        March<F> march{ray.active, p / num_layers, ray.uv, F(1) / num_layers};
        descend(io, march);
        SearchResult<F>& result = march.result;
        const vec2<F> uv = secant(io, ray, march);
        const Mask<F> ended = !march.active;
        const Mask<F> no_number = is_nan(result.h) | !is_finite(uv.x + uv.y);
        result.status = search_status<F>(ended, ended & no_number, Status::cap);
        result.s = march.current_depth;
        result.steps = result.fetches;
        store_search(io, ray, result, uv);
    }

    template <class Io, class F>
    static void descend(const Io& io, March<F>& march) {
        for (int i = 0; i <= most_steps; ++i) {
            const F height = look_up(io, march.active, march.ofs);
            io.march_step(march.active, march.current_depth, march.ofs, F(1) - march.current_depth,
                          height);
            march.result.h = select(march.active, height, march.result.h);
            march.depth = select(march.active, F(1) - height, march.depth);
            count_in<F>(march.result.fetches, march.active);
            march.active = march.active & (march.current_depth < march.depth);
            if (!any(march.active) || i == most_steps) break;
            march.ofs = select(march.active, march.ofs - march.delta, march.ofs);
            march.current_depth =
                select(march.active, march.current_depth + march.layer_depth, march.current_depth);
        }
    }

    /// Between the last sample and the one before it; the last itself in lanes that were cut off.
    template <class Io, class F>
    static vec2<F> secant(const Io& io, const SearchRay<F>& ray, March<F>& march) {
        const vec2<F> prev_ofs = select(ray.active, march.ofs + march.delta, march.ofs);
        const F height = look_up(io, ray.active, prev_ofs);
        const F s = march.current_depth - march.layer_depth;
        io.march_step(ray.active, s, prev_ofs, F(1) - s, height);
        count_in<F>(march.result.fetches, ray.active);
        const F after_depth = march.depth - march.current_depth;
        const F before_depth = (F(1) - height) - march.current_depth + march.layer_depth;
        const F weight = after_depth / (after_depth - before_depth);
        return select(march.active, march.ofs, mix(march.ofs, prev_ofs, weight));
    }
};

}  // namespace quadrel
