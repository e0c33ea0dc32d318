// relief-gg3: the relief mapping of GPU Gems 3's demonstration, as listed.
//
// Source: F. Policarpo, M. M. Oliveira, GPU Gems 3, chapter 18, relief_mapping.fx, ray_intersect_
// relief. Its v, scaled to unit depth, is (K, 1); p.z is s; its map holds 1 - h. Kept:
//   * p is accumulated and moves only while it is above the surface; there is no early exit, so
//     every step is a fetch;
//   * the binary steps are half steps forward or back from the last p, not a bisection: the first
//     may lead forward;
//   * the end is never tested. Here: FLOOR where no sample was at or below the surface;
//   * level 0 (the demonstration's sampler has MipFilter = None).
// Not reproduced: the 8 bits of its map; its depth bias and border clamp, both off by default.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/course_heights.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ReliefGg3 : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"relief-gg3", "trace",
                                    "linear search and signed half steps as listed",
                                    "Policarpo, Oliveira, GPU Gems 3, chapter 18"};
    static constexpr auto inputs = search_inputs;
    static constexpr const char* not_reproduced =
        "the 8 bits of its map; depth bias and border clamp, off by default";
    struct Params {
        std::int32_t linear_steps = 15, binary_steps = 6;
    };
    static constexpr std::array parameters{
        parameter<&Params::linear_steps>("linear_steps", "1", "steps over the relief's depth", 1,
                                         most_steps, 15),
        parameter<&Params::binary_steps>("binary_steps", "1", "signed half steps", 0, 60, 6)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) { return params.linear_steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = settled_heights_of_level(io, F(0));
        Walk<F> walk{vec3<F>(ray.uv, F(0))};
        const F n = number<F>(params.linear_steps);
        vec3<F> v(ray.K / n, F(1) / n);
        const Course course{[](const vec3<F>& p) { return vec2<F>(p); },
                            [](const vec3<F>& p, F h) { return p.z < F(1) - h; },
                            [&](const vec3<F>& p) { return p + v; }};
        Mask<F> moves = ray.active;
        for (const auto k :
             steps_on_course<F>(course, walk.p, heights, moves, 1, params.linear_steps)) {
            moves = moves & walk.above(io, heights, ray.active);
            walk.p = select(moves, course.next(walk.p), walk.p);
        }
        for (const auto k : steps<F>(1, params.binary_steps)) {
            v = v * F(0.5f);
            const Mask<F> above = walk.above(io, heights, ray.active);
            walk.p = select(above, walk.p + v, walk.p - v);
        }
        walk.result.s = walk.p.z;
        walk.result.status = search_status<F>(walk.found, walk.met_nan);
        walk.result.fetches = walk.result.steps;
        store_search(io, ray, walk.result, vec2<F>(walk.p));
    }

  private:
    template <Number F>
    struct Walk {
        vec3<F> p;
        SearchResult<F> result{};
        Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);

        /// Fetches at p: whether it is above the surface.
        template <class Io, class Heights>
        Mask<F> above(const Io& io, const Heights& heights, Mask<F> active) {
            const F h = heights(active, vec2<F>(p));
            io.march_step(active, p.z, vec2<F>(p), F(1) - p.z, h);
            const Mask<F> above = p.z < F(1) - h;
            result.h = h;
            met_nan = met_nan | (active & is_nan(h));
            found = found | (active & !above);
            count_in<F>(result.steps, active);
            return above;
        }
    };
};

}  // namespace quadrel
