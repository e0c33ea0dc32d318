// What the two listings of Rabbid76's page share: the number of steps and the march.
//
// Source: Rabbid76, "Parallax Mapping" (github.com/Rabbid76/graphics-snippets), functions Parallax
// of "Parallax Occlusion Mapping" and "Relief Parallax Mapping". texDir3D is the unit view ray in
// texture space, (K, -1) normalised, (K, +1) seen from behind; frontFace is 1 or -1. Kept:
//   * the number of steps is real, int() of it is marched: the bottom plane is not reached;
//   * heights are clamped to [0, 1]; look-ups take implicit derivatives, in the loops too: lanes
//     that left keep their last coordinate (in the repository's examples maps have one level:
//     "mip": "none");
//   * seen from behind, the march runs back from the far end of the ray with 1 - h.
// Not part of the rows is the listing's main, which leaves texture coordinates alone at scales
// below 0.001.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct RabbidParams {
    float quality_normal = 0.5f, quality_grazing = 1;
};

/// The variables of the listings, named as there.
template <Number F>
struct RabbidMarch {
    F quality, surf_sign, back_face;
    vec2<F> texStep, texC, at;  ///< at: of the last look-up
    F bumpHeightStep;
    F mapHeight = F(1), bestBumpHeight = F(1);
    Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);
    Int<F> fetches = Int<F>(0);

    RabbidMarch(const SearchRay<F>& ray, F frontFace, const RabbidParams& params) {
        const vec3<F> texDir3D = normalize(vec3<F>(ray.K, -frontFace));
        quality = mix(F(params.quality_normal), F(params.quality_grazing),
                      F(1) - pow(abs(normalize(texDir3D).z), F(2)));
        surf_sign = frontFace;
        back_face = step(F(0), -surf_sign);
        texStep = vec2<F>(texDir3D) * surf_sign / abs(texDir3D.z);
        texC = ray.uv + texStep * surf_sign + texStep * back_face;
        at = ray.uv;
        bumpHeightStep = F(1) / rabbid_steps(quality);
    }

    /// Fetches at the height bestBumpHeight in the lanes of `active`.
    template <class Io>
    void fetch(const Io& io, const ImplicitHeights<Io>& heights, Mask<F> active) {
        at = select(active, texC - texStep * bestBumpHeight, at);
        const F h = heights(active, at);
        met_nan = met_nan | (active & is_nan(h));
        mapHeight = select(active, back_face + surf_sign * clamp(h, F(0), F(1)), mapHeight);
        io.march_step(active, F(1) - bestBumpHeight, at, bestBumpHeight, mapHeight);
        count_in<F>(fetches, active);
    }

    template <class Io>
    void march(const Io& io, const ImplicitHeights<Io>& heights, Mask<F> active) {
        const F numSteps = trunc(rabbid_steps(quality));
        // From behind, a higher surface is met later.
        const Course course{
            [&](F best) { return select(active, texC - texStep * best, at); },
            [&](F best, F h) { return (surf_sign > F(0)) & !(clamp(h, F(0), F(1)) >= best); },
            [&](F best) { return best - bumpHeightStep; }};
        for (const auto i :
             steps_on_course<F>(course, bestBumpHeight, heights, active, 0, 49, numSteps - F(1))) {
            active = active & (number<F>(i) < numSteps);
            if (none(active)) break;
            fetch(io, heights, active);
            const Mask<F> hit = active & (mapHeight >= bestBumpHeight);
            found = found | hit;
            active = active & !hit;
            bestBumpHeight = select(active, course.next(bestBumpHeight), bestBumpHeight);
        }
    }

    /// The listings' last lines: s = 1 - height; FLOOR where the march found nothing.
    template <class Io>
    void finish(const Io& io, const SearchRay<F>& ray) {
        const F correction = (bestBumpHeight - mapHeight) / bumpHeightStep;
        bestBumpHeight = bestBumpHeight - bumpHeightStep * clamp(correction, F(0), F(1));
        SearchResult<F> result;
        result.s = F(1) - bestBumpHeight;
        result.h = mapHeight;
        result.status = search_status<F>(found, met_nan);
        result.steps = fetches;
        result.fetches = fetches;
        store_search(io, ray, result, texC - texStep * bestBumpHeight);
    }
};

/// 1 seen from the triangle's counter-clockwise side, else -1. The stage loads P and Ng.
template <class Io, class F = typename Io::Number>
F front_face(const Io& io) {
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    return select(dot(io.template load<Value::Ng>(), V) < F(0), F(-1), F(1));
}

inline constexpr std::array rabbid_parameters{
    parameter<&RabbidParams::quality_normal>("quality_normal", "1", "quality seen from above", 0, 2,
                                             0.5),
    parameter<&RabbidParams::quality_grazing>("quality_grazing", "1", "quality along the surface",
                                              0, 2, 1)};

/// What both rows have in common.
struct RabbidSearch : HeightSearch {
    static constexpr bool runs_on_duals = true;
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = values_and(level_0_search_inputs, Value::P, Value::Ng);
    static constexpr const char* not_reproduced =
        "the listing's main, which leaves texture coordinates alone at scales below 0.001";
    using Params = RabbidParams;
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params&) { return 50; }
    static constexpr auto parameters = rabbid_parameters;
};

}  // namespace quadrel
