// pom-dxsdk: the pixel shader of the DirectX SDK's parallax occlusion mapping, as listed.
//
// Source: N. Tatarchuk, ATI, DirectX SDK sample ParallaxOcclusionMapping.fx, RenderScenePS, up to
// the displaced coordinate. Its vParallaxOffsetTS is -K. Kept:
//   * n = trunc(lerp(50, 8, N.V)); bound and coordinate are accumulated; the first sample is one
//     step in, and the height before it is taken to be 1, so that a hit in the first interval gives
//     the offset 0;
//   * the test is strict; a ray without a hit, or whose line of heights runs along the ray, takes
//     the full offset: FLOOR and HIT;
//   * fetches with the gradients of the undisplaced UV; beyond mip level `lod_threshold` of the
//     map no offset, blended over the level before it.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct PomDxsdk : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"pom-dxsdk", "trace", "parallax occlusion mapping as listed",
                                    "Tatarchuk, DirectX SDK, ParallaxOcclusionMapping.fx"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t max_samples = 50, min_samples = 8, lod_threshold = 3;
    };
    static constexpr std::array parameters{
        parameter<&Params::max_samples>("max_samples", "1", "steps along the surface", 1,
                                        most_steps, 50),
        parameter<&Params::min_samples>("min_samples", "1", "steps seen from above", 1, most_steps,
                                        8),
        parameter<&Params::lod_threshold>("lod_threshold", "levels",
                                          "level from which on there is no offset", 0, 17, 3)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.max_samples, params.min_samples);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F level = mip_level(io, ray.uv);
        const F threshold(static_cast<Scalar<F>>(params.lod_threshold));
        const Mask<F> near = level <= threshold;
        const auto march = interval(io, ray, ray.active & near, params);
        const F amount = march.meeting();
        const vec2<F> offset = ray.uv + ray.K * (F(1) - amount);
        const vec2<F> faded = lerp(offset, ray.uv, level - trunc(level));
        const vec2<F> uv = select(level > threshold - F(1), faded, offset);

        SearchResult<F> result;
        result.s = select(near, F(1) - amount, F(ray.s_polygon));
        result.h = march.prev_height;
        result.status = search_status<F>(march.found | !near, march.met_nan);
        result.steps = march.samples;
        result.fetches = march.samples;
        store_search(io, ray, result, select(near, uv, ray.uv));
    }

  private:
    template <Number F>
    struct Interval {
        vec2<F> pt1 = vec2<F>(F(0)), pt2 = vec2<F>(F(0));  ///< (bound, height)
        F prev_height = F(1);
        Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);
        Int<F> samples = Int<F>(0);

        /// Bound at which the ray meets the line through pt1 and pt2; 0 if it meets none.
        F meeting() const {
            const F delta2 = pt2.x - pt2.y, delta1 = pt1.x - pt1.y;
            const F denominator = delta2 - delta1;
            return select(denominator == F(0), F(0),
                          (pt1.x * delta2 - pt2.x * delta1) / denominator);
        }
    };

    /// max(0.5 log2 of the larger squared gradient, 0), texels of level 0 as the unit.
    template <class Io, class F>
    static F mip_level(const Io& io, const vec2<F>& uv) {
        const vec2<F> texels = uv * TexelSize<F>(height_map(io)).texels;
        const vec2<F> dx = dFdx(texels, io.frame().derivatives);
        const vec2<F> dy = dFdy(texels, io.frame().derivatives);
        const vec2<F> squares = dx * dx + dy * dy;
        return max(F(0.5f) * log2(max(squares.x, squares.y)), F(0));
    }

    template <class Io, class F>
    static Interval<F> interval(const Io& io, const SearchRay<F>& ray, Mask<F> active,
                                const Params& params) {
        const SettledHeights<Io> heights(io, undisplaced_lod(io, height_map(io)));
        const F r = io.template load<Value::r>();
        const F n = trunc(lerp(F(static_cast<Scalar<F>>(params.max_samples)),
                               F(static_cast<Scalar<F>>(params.min_samples)), r));
        const F step = F(1) / n;
        const vec3<F> on(ray.K * step, -step);
        Interval<F> march;
        vec3<F> at(ray.uv, F(1));  // the coordinate and the bound
        const Course course{
            [&](const vec3<F>& from) { return vec2<F>(from + on); },
            [&](const vec3<F>& from, F height) { return !(height > (from + on).z); },
            [&](const vec3<F>& from) { return from + on; }};
        for (const auto i : steps_on_course<F, Before::needed>(course, at, heights, active, 0,
                                                               most_steps - 1, n - F(1))) {
            active = active & (number<F>(i) < n);
            if (none(active)) break;
            at = course.next(at);
            const F height = heights(active, vec2<F>(at)), bound = at.z;
            io.march_step(active, F(1) - bound, vec2<F>(at), bound, height);
            const Mask<F> hit = active & (height > bound);
            march.pt1 = select(hit, vec2<F>(bound, height), march.pt1);
            march.pt2 = select(hit, vec2<F>(bound + step, march.prev_height), march.pt2);
            march.prev_height = select(active, height, march.prev_height);
            march.met_nan = march.met_nan | (active & is_nan(height));
            march.found = march.found | hit;
            count_in<F>(march.samples, active);
            active = active & !hit;
        }
        return march;
    }
};

}  // namespace quadrel
