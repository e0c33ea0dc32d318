// rabbid-relief: the "relief parallax mapping" of Rabbid76's page, as listed.
//
// Source: Rabbid76, "Parallax Mapping", section Relief Parallax Mapping (rabbid_march.hpp says what
// is kept). After the march one step back, whether or not it found something, then
// int(clamp(10 q, 1, 7)) halvings; the last height is corrected by at most one of the last steps.
// The repository's example has the qualities (2, 1), so always 50 and 7; the defaults here are the
// page's range.
#pragma once

#include "quadrel/relief/trace/march/rabbid_march.hpp"

namespace quadrel {

struct RabbidRelief : RabbidSearch {
    static constexpr StageText text{"rabbid-relief", "trace", "linear and binary search as listed",
                                    "Rabbid76, Parallax Mapping, Relief Parallax Mapping"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        RabbidMarch<F> listing(ray, front_face(io), params);
        const ImplicitHeights heights(io);
        listing.march(io, heights, ray.active);
        refine(io, heights, ray, listing);
        listing.finish(io, ray);
    }

  private:
    template <class Io, class F>
    static void refine(const Io& io, const ImplicitHeights<Io>& heights, const SearchRay<F>& ray,
                       RabbidMarch<F>& listing) {
        const F numBinarySteps = trunc(clamp(listing.quality * F(10), F(1), F(7)));
        F& best = listing.bestBumpHeight;
        best = best + listing.bumpHeightStep;
        for (const auto i : steps<F>(0, 6)) {
            const Mask<F> active = ray.active & (number<F>(i) < numBinarySteps);
            if (none(active)) break;
            const F half = listing.bumpHeightStep * F(0.5f);
            listing.bumpHeightStep = select(active, half, listing.bumpHeightStep);
            best = select(active, best - listing.bumpHeightStep, best);
            listing.fetch(io, heights, active);
            const F back = select(best < listing.mapHeight, listing.bumpHeightStep, F(0));
            best = select(active, best + back, best);
        }
    }
};

}  // namespace quadrel
