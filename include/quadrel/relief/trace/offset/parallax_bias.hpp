// parallax-bias: parallax mapping with Welsh's bias, in units of the relief's depth.
//
// Corrects parallax-bias@published: the shift is along the frame's K, so that it is right for any
// UV map, and scale and bias are not a pair of UV lengths: the scale is the relief's depth, and the
// bias says which part of it lies above the polygon, whatever the material's seat. Welsh's example
// (0.04, -0.02) is a bias of -1/2.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"

namespace quadrel {

struct ParallaxBias : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"parallax-bias", "trace",
                                    "shift by the height at the start, scaled and biased",
                                    "correction of parallax-bias@published; Welsh 2004, 4.1"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        float bias = -0.5f;
    };
    static constexpr std::array parameters{parameter<&Params::bias>(
        "bias", "relief depths", "added to the height: minus the polygon's height", -1, 0, -0.5)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        SearchRay<F> ray = search_ray(io);
        ray.s_polygon = Scalar<F>(1) + Scalar<F>(params.bias);
        store_search(io, ray, offset_result(ray, height_at_start(io, ray)));
    }
};

}  // namespace quadrel
