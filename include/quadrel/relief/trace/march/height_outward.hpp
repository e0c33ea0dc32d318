// height-outward: FlightGear's height mapping over the whole height range.
//
// Source: T. Renk, FlightGear wiki, "Howto: Shader programming in FlightGear", relief maps (2016).
// Corrects height-outward@published: the march starts where the ray enters the relief (the listing
// starts 0.6 depths of ray length out and cuts off what is higher), samples are indexed, positions
// are texture coordinates along the frame's K, and the test is >=. Kept: the polygon itself is not
// tested; a ray without a crossing ends there (with the relief's seat at 0, as in the source, that
// is the bottom plane), FLOOR. At most 1 / n late, never early; misses what is thinner.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"

namespace quadrel {

struct HeightOutward : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"height-outward", "trace",
                                    "linear search that leaves out the bottom plane",
                                    "correction of height-outward@published; Renk 2016"};
    static constexpr auto inputs = search_inputs;
    struct Params {
        std::int32_t points = 50;
    };
    static constexpr std::array parameters{
        parameter<&Params::points>("points", "1", "points over the relief's depth", 1, 65536, 50)};
    static std::int32_t lattice_steps(const Params& params) { return params.points - 1; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const F n(static_cast<Scalar<F>>(params.points));
        store_search(io, ray,
                     result_of(first_bracket(tested_heights(io, heights), ray, n, params.points - 1,
                                             Before::not_needed)));
    }
};

}  // namespace quadrel
