// linear-thesis: the linear search of the thesis, as published.
//
// Source: "Derivative-Based Relief Mapping" (2012), appendix, Parallax.frag, "Set up Parallax
// Sampling Loop". Defects kept:
//   * it marches world depth 0 to 1 in steps of 1/128 whatever the relief's depth;
//   * 129 tests, and a ray that never breaks ends at 129/128;
//   * the test is strict, so that every pixel moves at least one step over a flat top;
//   * texture() in the loop takes implicit derivatives: lanes that left keep their last coordinate,
//     as on a GPU that runs the quad in lockstep;
//   * the comment announces a binary search; no code follows.
// The listing reads .r, which is alpha in its bitmaps: the height map's swizzle chooses the
// channel.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

struct LinearThesis : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "linear-thesis", "trace", "linear search of the thesis in world-depth steps of 1/128",
        "Derivative-Based Relief Mapping (2012), appendix, Parallax.frag 1"};
    static constexpr const char* not_reproduced =
        "the channel (.r of a bitmap whose first is alpha): the height map's swizzle chooses it";
    static constexpr auto inputs = values(Value::uv, Value::uv_rate, Value::relief_depth,
                                          Value::frame_status, Value::frame_flags);
    static constexpr bool needs_height_map = true;

    static constexpr int max_samples = 128;
    static constexpr float offset_per_sample = 0.0f + 1.0f / 128.0f;
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params&) { return max_samples + 1; }

    template <class Io>
    void operator()(Io& io, const Params&) const {
        run(io, ImplicitHeights(io));
    }

    /// Over heights of implicit levels.
    template <class Io, class Heights>
    static void run(Io& io, const Heights& heights) {
        using F = typename Io::Number;
        const vec2<F> UV = io.template load<Value::uv>();
        const vec2<F> dUVdSR = io.template load<Value::uv_rate>();
        const F scalar = io.template load<Value::relief_depth>();
        const Course course{[&](F offset) { return UV + dUVdSR * offset; },
                            [&](F offset, F texel) { return !(offset > (F(1) - texel) * scalar); },
                            [&](F offset) { return offset + F(offset_per_sample); }};

        Mask<F> active = io.active(), met_nan(false);
        F offset(0), h(0);
        Int<F> fetches(0);
        for (const auto sample :
             steps_on_course<F>(course, offset, heights, active, 0, max_samples)) {
            const vec2<F> at = course.at(offset);
            const F texel = heights(active, at);
            io.march_step(active, offset / scalar, at, F(1) - offset / scalar, texel);
            h = select(active, texel, h);
            met_nan = met_nan | (active & is_nan(texel));
            fetches = fetches + select(active, Int<F>(1), Int<F>(0));
            active = active & course.passes(offset, texel);
            offset = select(active, course.next(offset), offset);
            if (none(active)) break;
        }
        const vec2<F> hit = course.at(offset);
        io.template store<Value::hit_uv>(hit);
        io.template store<Value::hit_s>(offset / scalar);
        io.template store<Value::hit_h>(h);
        io.template store<Value::hit_depth>(offset);
        io.template store<Value::hit_status>(
            select(met_nan, status_packet<F>(Status::nan),
                   select(active, status_packet<F>(Status::floor), status_packet<F>(Status::hit))));
        io.template store<Value::hit_flags>(io.template load<Value::frame_flags>() |
                                            nan_look_up_flag(hit));
        io.template store<Value::hit_steps>(fetches);
        io.template store<Value::hit_fetches>(fetches);
    }
};

}  // namespace quadrel
