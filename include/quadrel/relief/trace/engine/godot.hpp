// godot: the height map of Godot Engine's standard material, as its shader has it.
//
// Source: Godot Engine, BaseMaterial3D, scene/resources/material.cpp, _update_shader, at 0059d788
// (4.x). `deep` off: an offset by the depth, 1 - height. `deep` on, "deep parallax": the march of
// LearnOpenGL's parallax occlusion mapping (layer_march.hpp says what is kept of it). The scale is
// the material's: 1 is 0.01 in UV. Kept: neither mode divides by the view vector's z. The ray's
// slope is the sine of the angle of view, not its tangent, and depths look too small along the
// surface. Look-ups take implicit derivatives. The relief's depth and seat move hit.depth alone.
// The engine's y axis is its bitangent negated, which points up the picture: along growing v, as
// the bitangent does here. Not reproduced: the engine's frame, whose tangents are interpolated and
// not normalised, with EYE_OFFSET of stereo and heightmap_flip; the shift of a second UV set, which
// subtracts the whole coordinate. An inverted map is a swizzle here.
#pragma once

#include "quadrel/relief/trace/engine/layer_march.hpp"
#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct Godot : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"godot", "trace", "Godot's height map, simple or deep",
                                    "Godot Engine, BaseMaterial3D, scene/resources/material.cpp"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (tangents interpolated and not normalised, EYE_OFFSET of stereo, "
        "flipped axes); parallel projections, where its view vector still comes from the "
        "camera's place; the shift of a second UV set";
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t deep = 0, min_layers = 8, max_layers = 32;
        float scale = 5;
    };
    static constexpr std::array parameters{
        choice<&Params::deep>("deep", "deep parallax, a search", off_on, 0),
        parameter<&Params::min_layers>("min_layers", "1", "layers seen from above, if deep", 1, 64,
                                       8),
        parameter<&Params::max_layers>("max_layers", "1", "layers along the surface, if deep", 1,
                                       64, 32),
        parameter<&Params::scale>("scale", "0.01 UV", "UV length of the height range, times 100",
                                  -16, 16, 5)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.deep != 0 ? std::max(params.min_layers, params.max_layers) : 0;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view_dir = normalize(tangent_viewer(io));
        const F scale(params.scale), unit(0.01f);
        if (params.deep) {
            const F layers = layers_by_angle(params.min_layers, params.max_layers, view_dir.z);
            store_layer_march(io, ray, vec2<F>(view_dir) * scale * unit, layers);
            return;
        }
        const F height = implicit_height_at_start(io, ray);
        const vec2<F> offset = vec2<F>(view_dir) * (F(1) - height) * scale * unit;
        store_search(io, ray, offset_result(ray, height), ray.uv - offset);
    }
};

}  // namespace quadrel
