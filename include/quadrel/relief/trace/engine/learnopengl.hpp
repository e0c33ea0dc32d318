// learnopengl: the parallax occlusion mapping of the tutorial "Learn OpenGL".
//
// Source: J. de Vries, Learn OpenGL, Advanced Lighting, "Parallax Mapping"; 5.3.parallax_mapping.fs
// at 7dc79cd5, function ParallaxMapping. The eye is that of 5.3.parallax_mapping.vs: the points of
// viewer and surface in the tangent space of each vertex, interpolated, their difference normalised
// (here from eye space, where the viewer is the origin: the world's sums round otherwise); no frame
// gives a vector. layer_march.hpp says what is kept of its march. Its map
// holds depths, here 1 - height. Kept: the number of layers takes |z| of the view vector, the
// offset is divided by z as it is, so that nothing bounds it along the surface, and triangles seen
// from behind march the other way. Its constants of 8 and 32 layers are parameters here, its height
// scale of 0.1 is the program's. The relief's depth and seat move hit.depth alone. The tutorial
// discards fragments whose coordinate leaves [0, 1]; scenes ask for that (clip-uv).
#pragma once

#include "quadrel/relief/trace/engine/layer_march.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct LearnOpenGl : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"learnopengl", "trace",
                                    "Learn OpenGL's parallax occlusion mapping",
                                    "de Vries, Learn OpenGL, Parallax Mapping"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr const char* not_reproduced =
        "the fragments that it discards outside of [0, 1]: scenes ask for that (clip-uv)";
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_vertices = true;
    struct Params {
        std::int32_t min_layers = 8, max_layers = 32;
        float scale = 0.1f;
    };
    static constexpr std::array parameters{
        parameter<&Params::min_layers>("min_layers", "1", "layers seen from above", 1, 1024, 8),
        parameter<&Params::max_layers>("max_layers", "1", "layers along the surface", 1, 1024, 32),
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.1)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.min_layers, params.max_layers);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> view_dir = normalize(-tangent_frag_pos(io));
        const vec2<F> P = vec2<F>(view_dir) / view_dir.z * F(params.scale);
        store_layer_march(io, ray, P,
                          layers_by_angle(params.min_layers, params.max_layers, view_dir.z));
    }

  private:
    /// TangentFragPos, interpolated; TangentViewPos is 0.
    template <class Io, class F = typename Io::Number>
    static vec3<F> tangent_frag_pos(const Io& io) {
        const VertexProgram program(io);
        return program.varying([&](const Vertex<F>& vertex) {
            const vec3<F> T = normalize(program.vector_to_eye(vertex.tangent));
            const vec3<F> B = normalize(program.vector_to_eye(vertex.binormal));
            const vec3<F> N = normalize(program.vector_to_eye(vertex.normal));
            const vec3<F> FragPos = program.point_to_eye(vertex.position);
            return vec3<F>(dot(T, FragPos), dot(B, FragPos), dot(N, FragPos));
        });
    }
};

}  // namespace quadrel
