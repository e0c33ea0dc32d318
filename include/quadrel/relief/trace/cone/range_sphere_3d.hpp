// The walk by distances to the surface, sphere-3d, on ranges: every step is taken for all positions
// that it may begin at (range_walk.hpp).
#pragma once

#include "quadrel/relief/trace/cone/range_baked_maps.hpp"

namespace quadrel {

/// sphere-3d on ranges.
struct Sphere3dOnRanges : Sphere3d {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        const DistanceVolume<TextureSlot::distance_exact, Io> volume(io);
        const Ranges voxels = length(vec3<Ranges>(ray.K * volume.size(), volume.layers()));
        const Ranges reach = volume.layers() / voxels;
        static thread_local KnownWalks known;
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            const WalkEnds& ends = known.of(ray, lane, [&] {
                return walk_parts(
                    params.steps, finest_piece(ray, lane), [&](const RealInterval& piece) {
                        return step(ray, volume, reach, params.tolerance, piece, lane);
                    });
            });
            const WalkOutcome outcome = outcome_of(ends, lane);
            result.s.lane[lane] = Ranged(outcome.s);
            result.status.lane[lane] =
                outcome.known ? statuses(outcome.first, outcome.last) : any_status();
        }
        result.h = Ranges(1) - result.s;
        result.steps = result.fetches = any_count();
        result.flags = any_flags();
        store_search(io, ray, result);
    }

  private:
    template <class Volume>
    static range_detail::WalkStep step(const SearchRay<Ranges>& ray, const Volume& volume,
                                       const Ranges& reach, double tolerance,
                                       const RealInterval& piece, int lane) {
        using namespace range_detail;
        const Aside aside;
        WalkStep step;
        const Ranges s = everywhere(piece);
        const Ranged distance = volume(only(lane), ray.at(s), Ranges(1) - s).lane[lane];
        step.known = distance.is_bounded() && reach.lane[lane].is_bounded();
        if (!step.known) return step;
        const RealInterval along = (max(distance, Ranged(0.0, 0.0)) * reach.lane[lane]).range();
        step.ends = along.lo <= tolerance;
        step.goes_on = along.hi > tolerance;
        if (!step.goes_on) return step;
        const Ranged length(std::max(along.lo, tolerance), along.hi);
        const RealInterval to = (Ranged(piece) + length).range();
        step.at_bottom = to.hi >= 1;
        step.goes_on = to.lo < 1;
        step.to = {std::max(to.lo, piece.lo), std::min(to.hi, 1.0)};
        return step;
    }
};

}  // namespace quadrel
