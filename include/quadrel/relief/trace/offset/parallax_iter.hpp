// parallax-iter: parallax mapping repeated, with the slope of the surface.
//
// Source: M. Premecz, "Iterative Parallax Mapping with Slope Information", CESCG 2006. A point p
// starts on the polygon and moves along the view ray, each time towards the plane that height and
// normal at p describe:
//     p += (h - p.z) n.z V,   so that in heights of the relief p.z rises by (h - p.z) n.z r
// (r = V.N). The plane is met by the same step over n.V; Premecz leaves the division out, so that
// a step stays bounded. `exact` on divides, except where the plane faces away from the eye, which
// no ray meets from above: there the step is Premecz' own.
// Differs: the shift is along the frame's K, so that it is right for any UV map; s stays in [0, 1].
// map_normal.hpp says which normal. No occlusion, and nothing says that the iteration converges.
#pragma once

#include "quadrel/relief/trace/search/map_normal.hpp"

namespace quadrel {

struct ParallaxIter : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"parallax-iter", "trace", "iterated shift by height and slope",
                                    "Premecz 2006"};
    static constexpr auto inputs = map_normal_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::normal);
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t iterations = 4;
        std::int32_t exact = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::iterations>("iterations", "1", "shifts in a row", 1, 1024, 4),
        choice<&Params::exact>("exact", "steps onto the plane itself", off_on, 0)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        SearchResult<F> result;
        result.s = F(ray.s_polygon);
        Mask<F> met_nan(false);
        for (const auto k : steps<F>(1, params.iterations)) {
            const vec2<F> at = ray.at(result.s);
            const F z = F(1) - result.s;
            result.h = heights(ray.active, at);
            io.march_step(ray.active, result.s, at, z, result.h);
            const auto normal = map_normal(io, heights, ray.active, at);
            const F next = result.s - rise(io, result.h - z, slope(io, normal.n), params.exact);
            met_nan = met_nan | (ray.active & is_nan(next));
            result.s = saturate(next);
            count_in<F>(result.steps, ray.active);
            count_normal(result.fetches, ray.active, normal);
        }
        result.fetches = result.fetches + result.steps;
        result.status = search_status<F>(ray.active, met_nan);
        store_search(io, ray, result);
    }

  private:
    /// One step's, in heights of the relief, towards a plane `gap` above.
    template <class Io, class F>
    static F rise(const Io& io, F gap, const Slope<F>& slope, bool exact) {
        const F step = gap * slope.nz * io.template load<Value::r>();
        return exact ? select(slope.nv > F(0), step / slope.nv, step) : step;
    }
};

}  // namespace quadrel
