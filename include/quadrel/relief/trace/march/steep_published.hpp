// steep@published and steep-constant-xy@published: the listing of steep parallax mapping.
//
// Source: M. McGuire and M. McGuire, "Steep Parallax Mapping", I3D 2005 poster, shader of the
// project's page; its second form is the pair of lines that stands there as a comment, for steps of
// constant length in the plane. (The page lost its closing braces; the loop ends with the fetch.)
// Kept:
//   * the number of steps is a real number, mix(2 n, n, N.V), and height and coordinate are
//     accumulated: the last sample lies below the bottom plane by a part of a step;
//   * the bump scale is a UV length; the relief's depth and seat move hit.depth alone;
//   * texture2D in the loop takes implicit derivatives: lanes that left keep their last coordinate;
//   * nothing bounds the loop (here: 65536 steps, CAP), and a NaN height ends it, NAN;
//   * the steps in the plane are 1 / (25.6 n) long, and their height is the page's, whose factors
//     25.6 n and 400 agree with the ray's slope for one number of steps and bump scale alone.
// _tsE is a varying: the eye in the vertices' tangent space, as his G3D shader of that name has it
// (vertex_frame.hpp), interpolated. The listing's tangent space has its y axis against growing v.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct SteepListingParams {
    std::int32_t steps = 5;
    float bump_scale = 0.05f;
};

template <bool constant_xy>
struct SteepListing : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text =
        constant_xy ? StageText{"steep-constant-xy@published", "trace",
                                "steep parallax mapping as listed, steps of constant UV length",
                                "McGuire and McGuire 2005, listing, commented lines"}
                    : StageText{"steep@published", "trace", "steep parallax mapping as listed",
                                "McGuire and McGuire 2005, listing"};
    static constexpr const char* not_reproduced =
        "the loop has a bound, 65536 steps; the vertex shader is the author's in G3D, the page "
        "shows none";
    static constexpr auto inputs = search_inputs;
    static constexpr bool reads_vertices = true;
    static constexpr bool needs_height_map = true;
    using Params = SteepListingParams;
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps seen from above", 1, 32768, 5),
        parameter<&Params::bump_scale>("bump_scale", "UV", "UV length of the height range", 0, 16,
                                       0.05)};
    static constexpr int most_steps = 65536;
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) { return 2 * params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto [delta, step] = listed_step(io, params);
        // offsetCoord and height
        vec3<F> march(ray.uv, F(1));
        const ImplicitHeights heights(io);
        const Course course{[](const vec3<F>& at) { return vec2<F>(at.x, at.y); },
                            [](const vec3<F>& at, F NB) { return NB < at.z; },
                            [&](const vec3<F>& at) { return at + vec3<F>(delta, -step); }};
        SearchResult<F> result;
        Mask<F> active = ray.active;
        for (const auto i : steps_on_course<F>(course, march, heights, active, 0, most_steps)) {
            const F NB = heights(active, course.at(march));
            io.march_step(active, F(1) - march.z, course.at(march), march.z, NB);
            result.h = select(active, NB, result.h);
            count_in<F>(result.steps, active);
            active = active & course.passes(march, NB);
            if (none(active)) break;
            const Mask<F> moves = active & (number<F>(i) < number<F>(most_steps));
            march = select(moves, course.next(march), march);
        }
        result.s = F(1) - march.z;
        result.status = search_status<F>(!active, is_nan(result.h), Status::cap);
        result.fetches = result.steps;
        store_search(io, ray, result, course.at(march));
    }

  private:
    template <Number F>
    struct ListedStep {
        vec2<F> delta;
        F step;
    };

    template <class Io, class F = typename Io::Number>
    static ListedStep<F> listed_step(const Io& io, const Params& params) {
        const vec3<F> axes = vertex_eye(io);
        const vec3<F> _tsE(axes.x, -axes.y, axes.z);
        const vec3<F> tsE = normalize(_tsE);
        const F bumpScale(params.bump_scale);
        const F few(static_cast<Scalar<F>>(params.steps));
        const F numSteps = mix(few * F(2), few, tsE.z);
        if constexpr (constant_xy) {
            const F in_plane = F(1) / (F(25.6f) * numSteps);
            return {vec2<F>(-tsE.x, tsE.y) * in_plane,
                    tsE.z * bumpScale * (F(25.6f) * numSteps) / (length(vec2<F>(tsE)) * F(400))};
        } else {
            return {vec2<F>(-_tsE.x, _tsE.y) * bumpScale / (_tsE.z * numSteps), F(1) / numSteps};
        }
    }
};

using SteepPublished = SteepListing<false>;
using SteepConstantXyPublished = SteepListing<true>;

}  // namespace quadrel
