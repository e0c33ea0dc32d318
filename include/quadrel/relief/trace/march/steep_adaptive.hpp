// steep-adaptive, steep-adaptive-rabbid, steep-quality: linear search with the numbers of steps
// that published marches take.
//
//   steep-adaptive         lerp(steps_grazing, steps_normal, r), rounded down, up or not at all.
//                          McGuire and McGuire 2005: (10, 5) unrounded, later (60, 10); DirectX
//                          SDK, ParallaxOcclusionMapping.fx: (50, 8), down; ezEngine: (n, n / 4),
//                          down.
//   steep-adaptive-rabbid  int(clamp(50 q, 1, 50)), q between two qualities by the ray's slope in
//                          texture space. Rabbid76, "Parallax Mapping", (0.5, 1).
//   steep-quality          16 2^quality, at any angle. O3DE, ParallaxMapping.azsli.
// All three search as `linear` does: samples at k / n (an unrounded n has its last at 1), the first
// at or below the surface, heights with the gradients of the undisplaced UV, else FLOOR. Their
// sources accumulate, and start or stop differently. Where a rounded n changes from one pixel to
// the next, bands show.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/quality.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// Marches n steps a lane, at most `most`, with the heights of a march, and stores the outcome.
template <class Io, class F = typename Io::Number>
void march_and_store(Io& io, const SearchRay<F>& ray, F n, int most) {
    const auto heights = march_heights(io);
    store_search(
        io, ray,
        result_of(first_bracket(tested_heights(io, heights), ray, n, most, Before::not_needed)));
}

struct SteepAdaptive : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"steep-adaptive", "trace",
                                    "linear search, steps by the angle of view",
                                    "McGuire and McGuire 2005; Tatarchuk 2006"};
    static constexpr auto inputs = search_inputs_and(Value::r);
    struct Params {
        std::int32_t steps_grazing = 60, steps_normal = 10, rounding = 0;
    };
    static constexpr ValueName rounding_names[] = {{0, "down"}, {1, "up"}, {2, "none"}};
    static constexpr std::array parameters{
        parameter<&Params::steps_grazing>("steps_grazing", "1", "steps along the surface", 1,
                                          most_steps, 60),
        parameter<&Params::steps_normal>("steps_normal", "1", "steps seen from above", 1,
                                         most_steps, 10),
        choice<&Params::rounding>("rounding", "of the number of steps", rounding_names, 0)};
    static std::int32_t lattice_steps(const Params& params) {
        return std::max(params.steps_grazing, params.steps_normal);
    }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const F n = steps_by_angle(io.template load<Value::r>(), params.steps_grazing,
                                   params.steps_normal, static_cast<StepRounding>(params.rounding));
        march_and_store(io, search_ray(io), n, std::max(params.steps_grazing, params.steps_normal));
    }
};

struct SteepAdaptiveRabbid : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"steep-adaptive-rabbid", "trace",
                                    "linear search, steps by slope and quality",
                                    "Rabbid76, Parallax Mapping"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        float quality_normal = 0.5f, quality_grazing = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::quality_normal>("quality_normal", "1", "quality seen from above", 0, 2,
                                           0.5),
        parameter<&Params::quality_grazing>("quality_grazing", "1", "quality along the surface", 0,
                                            2, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F q = rabbid_quality(ray.K, params.quality_normal, params.quality_grazing);
        march_and_store(io, ray, trunc(rabbid_steps(q)), 50);
    }
};

struct SteepQuality : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"steep-quality", "trace", "linear search, steps by quality",
                                    "O3DE, ParallaxMapping.azsli"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t quality = 0;
    };
    static constexpr std::array parameters{quality_parameter<&Params::quality>()};
    static std::int32_t lattice_steps(const Params& params) { return 16 << params.quality; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const int n = 16 << params.quality;
        march_and_store(io, search_ray(io), F(static_cast<Scalar<F>>(n)), n);
    }
};

}  // namespace quadrel
