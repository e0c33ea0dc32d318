// learnopengl: the parallax occlusion mapping of the tutorial "Learn OpenGL".
//
// Source: J. de Vries, Learn OpenGL, Advanced Lighting, "Parallax Mapping"; 5.3.parallax_mapping.fs
// at 7dc79cd5, function ParallaxMapping. layer_march.hpp says what is kept of its march. Its map
// holds depths, here 1 - height. Kept: the number of layers takes |z| of the view vector, the
// offset is divided by z as it is, so that nothing bounds it along the surface, and triangles seen
// from behind march the other way. Its constants of 8 and 32 layers are parameters here, its height
// scale of 0.1 is the program's. The relief's depth and seat move hit.depth alone. The tutorial
// discards fragments whose coordinate leaves [0, 1]; scenes ask for that (clip-uv).
#pragma once

#include "quadrel/relief/trace/layer_march.hpp"
#include "quadrel/relief/trace/tangent_eye.hpp"

namespace quadrel {

struct LearnOpenGl : StageDefaults {
    static constexpr StageText text{"learnopengl", "trace",
                                    "Learn OpenGL's parallax occlusion mapping",
                                    "de Vries, Learn OpenGL, Parallax Mapping"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs =
        values_and(level_0_search_inputs, Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t min_layers = 8, max_layers = 32;
        float scale = 0.1f;
    };
    static constexpr std::array parameters{
        parameter<&Params::min_layers>("min_layers", "1", "layers seen from above", 1, 1024, 8),
        parameter<&Params::max_layers>("max_layers", "1", "layers along the surface", 1, 1024, 32),
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view_dir = normalize(tangent_eye(io));
        const vec2<F> P = vec2<F>(view_dir) / view_dir.z * F(params.scale);
        store_layer_march(io, ray, P,
                          layers_by_angle(params.min_layers, params.max_layers, view_dir.z));
    }
};

}  // namespace quadrel
