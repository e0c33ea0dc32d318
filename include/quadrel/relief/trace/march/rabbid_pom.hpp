// rabbid-pom: the "parallax occlusion mapping" of Rabbid76's page, as listed.
//
// Source: Rabbid76, "Parallax Mapping", section Parallax Occlusion Mapping (rabbid_march.hpp says
// what is kept). Its final correction by clamp((best - map) / step, 0, 1) is 0 after every hit,
// because the march breaks on map >= best: this is steep parallax mapping. A ray that finds nothing
// takes up to one step more. `pom` has the correction that was meant.
#pragma once

#include "quadrel/relief/trace/march/rabbid_march.hpp"

namespace quadrel {

struct RabbidPom : RabbidSearch {
    static constexpr StageText text{"rabbid-pom", "trace",
                                    "linear search whose correction is always 0",
                                    "Rabbid76, Parallax Mapping, Parallax Occlusion Mapping"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        RabbidMarch<F> listing(ray, front_face(io), params);
        listing.march(io, ImplicitHeights(io), ray.active);
        listing.finish(io, ray);
    }
};

}  // namespace quadrel
