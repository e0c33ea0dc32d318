// multilayer@published: the search of four depths by products of signs, as listed.
//
// Source: the shader quad_depth_relief_mapping of F. Policarpo's relief mapping examples, of
// "Relief Mapping of Non-Height-Field Surface Details", I3D 2006 (ray_intersect_rmqd_linear,
// ray_intersect_rmqd_binary, relief_map_quad_depth; 10 steps there, 30 in a later copy for Unity,
// with the same search). With v the interpolated vector from the eye along tangent, binormal and
// normal of the vertices, its z turned round and all of it normalised:
//   * the ray starts half of the shift ahead of the UV, and the shift is `scale` times
//     2 v.z - v.z^2 over v.z: less depth the flatter the view;
//   * seen from behind (v.z < 0) it starts at 0.996 and goes up;
//   * inside is where the product of the four differences s - depth is below 0: a sample on a layer
//     is not, and is where the linear search, which only goes on where the product is above 0,
//     stays;
//   * the linear search has no exit, makes a step less than it is told, and leaves a last place
//   that
//     it does not test; the bisection halves steps from there, whether a bracket was found or not;
//   * where it never is inside, s is the sign of the direction, and misses as everything outside of
//     [0.003, 0.997] does.
// Look-ups take implicit derivatives, as tex2D does. The listing's own depth is `scale`; the
// relief's depth and seat move hit.depth alone. Binormals run along growing v here; the listing's
// are cross(N, T) times a handedness, those of its own meshes.
#pragma once

#include "quadrel/quad/vertex_program.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct MultilayerPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr bool reads_vertices = true;
    static constexpr StageText text{"multilayer@published", "trace",
                                    "four depths by products of signs, as listed",
                                    "Policarpo and Oliveira 2006, quad_depth_relief_mapping"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);
    struct Params {
        std::int32_t steps = 10, binary_steps = 5;
        float scale = 0.1f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "parts of the way; one less is made", 1, most_steps,
                                  10),
        parameter<&Params::binary_steps>("binary_steps", "1", "half steps", 0, 60, 5),
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        vec3<F> v = normalize(eye_vector(io));
        const F direction = v.z;
        v.z = abs(v.z);
        const F d = F(params.scale) * (F(2) * v.z - v.z * v.z);
        v = v / v.z;
        v.x = v.x * d;
        v.y = v.y * d;
        const Mask<F> from_behind = direction < F(0);
        vec3<F> s(ray.uv.x - v.x * F(0.5f), ray.uv.y - v.y * F(0.5f),
                  select(from_behind, F(0.996f), F(0)));
        v.z = select(from_behind, -v.z, v.z);
        Int<F> fetches(0);
        Mask<F> met_nan(false);
        // The product of the signs: below 0 inside.
        const auto side = [&](const vec3<F>& at) {
            const vec2<F> uv(at.x, at.y);
            const auto context = io.template context<TextureSlot::layers>(ray.active);
            const SampledTexture& map = layer_map(io);
            const vec4<F> t = layer_depths(map, texture(map, context, uv, io.frame().derivatives));
            io.march_step(ray.active, at.z, uv, F(1) - at.z, F(1) - nearest_layer<4>(t, at.z));
            count_in<F>(fetches, ray.active);
            met_nan = met_nan | (ray.active & has_nan<4>(t));
            const F x = at.z - t.x, y = at.z - t.y, z = at.z - t.z, w = at.z - t.w;
            return (x * z) * (y * w);
        };
        v = v / number<F>(params.steps);
        for (const auto i : steps<F>(1, params.steps - 1)) {
            const vec3<F> next = s + v;
            s = select(side(s) > F(0), next, s);
        }
        const F sign_of_way = sign(v.z);
        vec3<F> best(sign_of_way);
        for (const auto i : steps<F>(1, params.binary_steps)) {
            v = v * F(0.5f);
            const Mask<F> inside = side(s) < F(0);
            best = select(inside, s, best);
            s = select(inside, s - v * F(2), s);
            s = s + v;
        }
        const Mask<F> found = !((best.z > F(0.997f)) | (best.z < F(0.003f)));
        SearchResult<F> result;
        result.s = best.z;
        result.h = F(1) - best.z;
        result.status =
            search_status<F>(found, met_nan | !is_finite(best.x + best.y + best.z), Status::clip);
        result.steps = result.fetches = fetches;
        store_search(io, ray, result, vec2<F>(best));
    }

  private:
    /// From the eye, along the axes of the vertices in eye space; z towards the inside.
    template <class Io, class F = typename Io::Number>
    static vec3<F> eye_vector(const Io& io) {
        const VertexProgram program(io);
        return program.varying([&](const Vertex<F>& vertex) {
            const vec3<F> position = program.point_to_eye(vertex.position);
            const vec3<F> along(dot(program.vector_to_eye(vertex.tangent), position),
                                dot(program.vector_to_eye(vertex.binormal), position),
                                dot(program.vector_to_eye(vertex.normal), position));
            return vec3<F>(along.x, along.y, -along.z);
        });
    }
};

}  // namespace quadrel
