// curved-quadric@published: relief over one quadric, with its outline, as listed.
//
// Source: F. Policarpo's shader with correct silhouettes (of Oliveira and Policarpo 2005) as the
// Unity shader Relief_Correct_Silhouettes has it: vertex_shader, ray_position,
// ray_intersect_rm_curved, main_relief. With v the unit vector to the eye along tangent, minus
// binormal and normal of the vertices, interpolated:
//   * both coefficients are one constant, `curvature`, and the second is multiplied by v.z^2, not
//     v.y^2; what falls away is never less than 0.001 (but 0 where it is 0);
//   * the way ends at 50, where the ray is at the bottom, or where it is at the top again, and the
//     steps are of a way 0.001 longer; from there bisection goes both ways by half steps, bracket
//     or none;
//   * what ends behind the way is discarded, though a step may lead there from a hit.
// Look-ups take implicit derivatives, as tex2D does. `tile`, `scale` (the listing's depth) and the
// UV's own tiling are as many lengths of the mesh as they say there; tangents are taken to have the
// handedness -1 that makes the listing's x run away from the eye. hit.depth is where the ray is in
// the world; the relief's depth and seat do not count.
#pragma once

#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct CurvedQuadricPublished : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr bool reads_vertices = true;
    static constexpr StageText text{"curved-quadric@published", "trace",
                                    "relief over a quadric of one curvature, as listed",
                                    "Oliveira and Policarpo 2005, Relief_Correct_Silhouettes"};
    static constexpr auto inputs = values_and(level_0_search_inputs, Value::r);
    struct Params {
        std::int32_t steps = 40, binary_steps = 8;
        float scale = 0.1f, tile = 4, curvature = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps of the way", 1, most_steps, 40),
        parameter<&Params::binary_steps>("binary_steps", "1", "half steps", 0, 60, 8),
        parameter<&Params::scale>("scale", "world units times tile", "depth of the relief", 1e-6,
                                  1e6, 0.1),
        parameter<&Params::tile>("tile", "1", "UV a world unit", 1e-6, 1e6, 4),
        parameter<&Params::curvature>("curvature", "1/world unit", "both coefficients", -1e6, 1e6,
                                      1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const ImplicitHeights map(io);
        CountedHeights heights(io, map);
        const vec3<F> eye = vertex_eye(io);
        vec3<F> v = normalize(vec3<F>(eye.x, -eye.y, eye.z));
        const F tile(params.tile), curvature(params.curvature);
        const vec3<F> scale(F(-1) / tile, F(1) / tile, F(params.scale) / tile);
        const vec3<F> mapping = vec3<F>(F(1)) / scale;
        F falls = curvature * v.x * v.x + curvature * v.z * v.z;
        falls = sign(falls) * max(abs(falls), F(0.001f));
        const F way = way_of(v.z, falls, scale.z);
        v = v * mapping;
        falls = falls * mapping.z;
        const auto position = [&](F t) {
            vec3<F> r = v * t;
            r.z = r.z - t * t * falls;
            return vec3<F>(r.x + ray.uv.x, r.y + ray.uv.y, r.z);
        };
        const auto is_above = [&](F t) {
            const vec3<F> p = position(t);
            return p.z < F(1) - heights(ray.active, p.z, vec2<F>(p));
        };
        F t(0), size = (way + F(0.001f)) / number<F>(params.steps);
        for (const auto i : steps<F>(1, params.steps)) {
            const F next = t + size;
            t = select(is_above(t), next, t);
        }
        for (const auto i : steps<F>(1, params.binary_steps)) {
            size = size * F(0.5f);
            const F on = t + F(2) * size;
            t = select(is_above(t), on, t);
            t = t - size;
        }
        const vec3<F> p = position(t);
        const Mask<F> found = !(t > way);
        SearchResult<F> result = heights.result(p.z, vec2<F>(p), found);
        const Mask<F> is_nan = result.status == status_packet<F>(Status::nan);
        result.status = select(found | is_nan, result.status, status_packet<F>(Status::clip));
        store_search(io, ray, result, vec2<F>(p), t * io.template load<Value::r>());
    }

  private:
    /// tmax: min(t(z = 0), t(z = 1)).
    template <Number F>
    static F way_of(F z, F falls, F depth) {
        const F d = z * z - F(4) * falls * depth;
        const F down = min(F(50), (-z + sqrt(d)) / (F(-2) * falls));
        const F way = select(d > F(0), down, F(50));
        const F up = z / falls;
        return select(up > F(0), min(way, up), way);
    }
};

}  // namespace quadrel
