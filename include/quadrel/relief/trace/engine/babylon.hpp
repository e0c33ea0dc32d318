// babylon: Babylon.js' parallax mapping and, with `parallax_occlusion` on, parallax occlusion.
//
// Source: Babylon.js, bumpFragmentFunctions.fx (769119f), parallaxOffset and parallaxOcclusion,
// called from bumpFragment.fx. The height is the alpha of the normal map ("swizzle": "a"), `scale`
// the material's parallaxScaleBias, a UV length; the relief's depth and seat move hit.depth alone.
//
// The engine's cotangent frame is not divided by its determinant: in the default left-handed system
// it points to decreasing u and v, in a right-handed one to growing u and v, and the shader's signs
// (PARALLAX_RHS) make up for that, so that bumps are bumps in both. T and B grow with u and v here,
// so left-handed they are turned round before the shader's lines. With own_tangents = 1 they are
// not: tangents that a mesh brings along point to growing u and v in either system, and
// left-handed the relief comes out inverted.
//
// Kept:
//   * parallax moves by the unit vector's (x, y) times the height: no division by its z;
//   * parallax occlusion has 15 + 11 N.V steps, a real number: most where fewest are needed. It
//     makes 15 look-ups, so that seen from above 4 tenths of the range are never searched: FLOOR a
//     step below the last sample;
//   * seen exactly along the normal, normalize(0) makes its coordinate NaN: NAN;
//   * implicit derivatives in the loop, which runs on at the final coordinate behind a hit: steps
//     and fetches are 15; the test is strict; the secant's second weight takes the height before
//     the first sample to be 1.
// hit.s is the depth of the sample that hit, the secant moves hit.uv alone; hit.h is the
// height compared last. For the engine's own frame, its axes not of unit length, take
// frame-cot@published. Not reproduced: levels of the normal map other than 1 (the shader hands the
// frame its normal times the scale, so that they change the view vector's z), the texture's matrix,
// and back faces, for whose frame the shader negates the UV.
#pragma once

#include "quadrel/relief/trace/engine/babylon_march.hpp"
#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct BabylonParams {
    std::int32_t parallax_occlusion = 0;
    float scale = 0.05f;
    std::int32_t right_handed = 0, own_tangents = 0;
};

struct Babylon : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"babylon", "trace", "Babylon.js' parallax, plain and occlusion",
                                    "Babylon.js, bumpFragmentFunctions.fx"};
    static constexpr auto inputs =
        search_inputs_and(Value::P, Value::T, Value::B, Value::frame_normal);
    static constexpr const char* not_reproduced =
        "levels of the normal map other than 1, which lengthen the frame's normal; the "
        "texture's matrix; back faces, whose UV the frame takes negated; parallel "
        "projections, where its view vector still comes from the camera's place";
    static constexpr bool needs_height_map = true;
    using Params = BabylonParams;
    static constexpr std::array parameters{
        choice<&Params::parallax_occlusion>("parallax_occlusion", "useParallaxOcclusion", off_on,
                                            0),
        parameter<&Params::scale>("scale", "UV", "UV length of the height range", -16, 16, 0.05),
        choice<&Params::right_handed>("right_handed", "useRightHandedSystem", off_on, 0),
        choice<&Params::own_tangents>("own_tangents",
                                      "tangents of the mesh, inverted if left-handed", off_on, 0)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return params.parallax_occlusion != 0 ? BabylonMarch<float>::iMaxSamples : 0;
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> normal = io.template load<Value::frame_normal>();
        const vec3<F> view = turned(params, tangent_viewer(io));
        if (params.parallax_occlusion == 0) return limited(io, ray, view, params);
        const vec3<F> vNormalCoT = turned(params, along_frame(io, normal));
        search(io, ray, BabylonMarch<F>(-view, vNormalCoT, params.scale, ray.active), params);
    }

  private:
    /// In the engine's own frame.
    template <Number F>
    static vec3<F> turned(const Params& params, const vec3<F>& v) {
        const bool grows = params.right_handed != 0 || params.own_tangents != 0;
        return grows ? v : vec3<F>(-v.x, -v.y, v.z);
    }

    /// parallaxOffset.
    template <class Io, class F>
    static void limited(const Io& io, const SearchRay<F>& ray, const vec3<F>& viewDir,
                        const Params& params) {
        const F height = implicit_height_at_start(io, ray);
        const vec2<F> offset = vec2<F>(viewDir) * F(params.scale) * height;
        store_search(io, ray, offset_result(ray, height),
                     ray.uv + (params.right_handed != 0 ? offset : -offset));
    }

    /// parallaxOcclusion.
    template <class Io, class F>
    static void search(const Io& io, const SearchRay<F>& ray, BabylonMarch<F> march,
                       const Params& params) {
        const F side(static_cast<Scalar<F>>(params.right_handed != 0 ? -1 : 1));
        SearchResult<F> result;
        const ImplicitHeights heights(io);
        const Course course{[&](const vec3<F>& at) { return ray.uv + vec2<F>(at); },
                            [](const vec3<F>& at, F height) { return !(height > at.z); },
                            [&](const vec3<F>& at) { return march.next(at, side); }};
        for (const auto i : steps_on_course<F, Before::needed>(
                 course, march.at, heights, march.keepWorking, 1, march.iMaxSamples)) {
            const vec2<F> at = course.at(march.at);
            const F height = heights(ray.active, at);
            count_in<F>(result.steps, ray.active);
            io.march_step(march.keepWorking, F(1) - march.currRayHeight(), at,
                          march.currRayHeight(), height);
            march.test(height, side);
        }
        result.s = F(1) - march.currRayHeight();
        result.h = march.compared;
        result.status = search_status<F>(march.hit, march.met_nan | march.lost());
        result.fetches = result.steps;
        store_search(io, ray, result, course.at(march.at));
    }
};

}  // namespace quadrel
