// o3de: Open 3D Engine's parallax: basic, steep, occlusion (its default), relief, contact
// refinement.
//
// Source: O3DE, ParallaxMapping.azsli (354a2ac), BasicParallaxMapping and AdvancedParallaxMapping,
// with an identity UV transform, after which the unit eye vector is normalised once more. The
// height is read from red with the fine gradients of the undisplaced UV. `scale` is the material's
// factor and `offset` its offset, lengths in the tangent frame that are added to UV as they are: a
// unit of UV is taken to be a unit of the world. The relief's depth and seat move hit.depth alone.
// The bitangent must run along growing v; nothing is flipped.
//
// Kept:
//   * basic is limited to the unit vector's (x, y) times the depth, with no division by its z, and
//     knows no offset;
//   * the others march in 16, 32, 64 or 128 steps (`quality`), whatever the angle; depth and
//     offset are accumulated, the test is strict, and nothing bounds the loops (here: 65536 steps
//     each, CAP);
//   * a raised range is cut at the polygon, by a bound on the depths; a factor of 0.0001 or less
//     leaves the surface flat;
//   * relief halves as often as there are steps; the sign that it moves by may be 0, and stays so;
//   * contact's second march adds up anew, and where it misses what the first one met it walks on.
// hit.s is depth in the range from `offset` on, of the point that the shader ends with: occlusion
// interpolates the depth of its displacement as it does UV. hit.h is the height read last. Not
// reproduced: the engine's frame (ConstructTBN, normalised a fragment in object space and again in
// the world's), the UV transform, clip highlights, pixel depth offset and shadows. (Until June 2024
// CalculateParallaxOffset took dirToCameraTS for a float: every axis had its x.)
#pragma once

#include "quadrel/relief/trace/engine/o3de_search.hpp"
#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/quality.hpp"
#include "quadrel/relief/trace/search/tangent_eye.hpp"

namespace quadrel {

struct O3de : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"o3de", "trace", "Open 3D Engine's parallax, all algorithms",
                                    "O3DE, ParallaxMapping.azsli"};
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's frame (normalised a fragment, before it is turned to world space); the UV "
        "transform; clip highlights, pixel depth offset, shadows";
    using Params = O3deParams;
    static constexpr ValueName algorithm_names[] = {
        {0, "basic"}, {1, "steep"}, {2, "occlusion"}, {3, "relief"}, {4, "contact"}};
    static constexpr std::array parameters{
        choice<&Params::algorithm>("algorithm", "the engine's ParallaxAlgorithm", algorithm_names,
                                   2),
        quality_parameter<&Params::quality>(),
        parameter<&Params::scale>("scale", "UV", "factor: UV length of the height range", 0, 16,
                                  0.05),
        parameter<&Params::offset>("offset", "UV", "by how much the range is raised", -16, 16, 0)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.algorithm != 0 ? 16 << params.quality : 0;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> dirToCameraTS = normalize(normalize(tangent_eye(io)));
        if (params.algorithm == 0) return basic(io, ray, dirToCameraTS, params);
        O3deSearch<Io> search(io, ray, dirToCameraTS, params);
        search.march();
        if (params.algorithm == 2) search.interpolate();
        if (params.algorithm == 3) search.halve();
        if (params.algorithm == 4) search.march_again();
        store_search(io, ray, search.result(), search.uv());
    }

  private:
    template <class Io, class F>
    static void basic(const Io& io, const SearchRay<F>& ray, const vec3<F>& dirToCameraTS,
                      const Params& params) {
        const F s(ray.s_polygon), height = o3de_heights(io, ray.uv)(ray.active, ray.uv);
        io.march_step(ray.active, s, ray.uv, F(1) - s, height);
        const O3deRange<F> range(params.scale, F(0));
        const vec2<F> delta =
            vec2<F>(dirToCameraTS) * range.normalized_depth(height) * F(params.scale);
        store_search(io, ray, offset_result(ray, height), ray.uv + (vec2<F>(F(0)) - delta));
    }
};

}  // namespace quadrel
