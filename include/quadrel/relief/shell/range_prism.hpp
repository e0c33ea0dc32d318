// The first hits of all rays of a range through a tetrahedron of a shell: what an exact search may
// give there (range_first_hit.hpp). Rays fall, rise or run level.
#pragma once

#include "quadrel/relief/shell/stages.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"

namespace quadrel {

namespace range_detail {

/// In terms of the ray's own parameter t.
class PrismHits {
  public:
    /// `start`, `shift`: depth where rays enter, and how much more at the end. `ends`: whether they
    /// end at or below any height.
    PrismHits(const SampledTexture& map, oracle::Surface surface, const oracle::RayRange& rays,
              const RealInterval& start, const RealInterval& shift, const RangeTruth& ends)
        : field_(map, surface),
          at_{{rays.u, rays.Ku, field_.texels().width(), 0},
              {rays.v, rays.Kv, field_.texels().height(), 0}},
          start_(start),
          shift_(shift),
          may_end_(ends.state != RangeTruth::no),
          ends_(ends.state == RangeTruth::yes) {}

    const RayPlaces& places() const { return at_; }

    Meets meets(double from, double to) const {
        const RealInterval all = heights(from, to);
        if (!std::isfinite(all.width())) return Meets::unknown;
        const bool below = all.hi < ray(from, to).lo - slack(all);
        return below && !(may_end_ && to == 1) ? Meets::none : Meets::some;
    }
    bool holds_all(double at) const {
        if (ends_ && at == 1) return true;
        const RealInterval end = heights(at, at);
        return end.lo >= ray(at, at).hi + slack(end);
    }
    /// The field's, whatever the ray's is.
    RealInterval height_in(const RealInterval& t) const {
        const RealInterval height = heights(t.lo, t.hi);
        return widened(height, height_slack(height));
    }

  private:
    RealInterval heights(double from, double to) const {
        return field_(at_.x.over(from, to), at_.y.over(from, to));
    }
    RealInterval ray(double from, double to) const {
        return RealInterval(1) - start_ - shift_ * RealInterval(from, to);
    }
    double slack(const RealInterval& height) const {
        return height_slack(height) + height_slack(shift_);
    }

    FieldRange field_;
    RayPlaces at_;
    RealInterval start_, shift_;
    bool may_end_, ends_;
};

}  // namespace range_detail

struct PrismExactOnRanges : PrismExact {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using namespace range_detail;
        const auto surface = static_cast<PrismSurface>(params.surface);
        const oracle::Surface between =
            surface == PrismSurface::bilinear   ? oracle::Surface::bilinear
            : surface == PrismSurface::tri_main ? oracle::Surface::tri_main
                                                : oracle::Surface::tri_anti;
        const PrismRay<Ranges> ray = prism_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.uv.active.lane[lane].known().state == RangeTruth::no) continue;
            take_any_hit(lane, result);
            const Ranged &start = ray.s.lane[lane], &shift = ray.s_shift.lane[lane];
            const auto rays = ray_range(ray.uv, lane);
            if (!rays || !start.is_bounded() || !shift.is_bounded()) continue;
            const PrismHits hits(map, between, *rays, start.range(), shift.range(),
                                 ray.ends_below.lane[lane].known());
            take_first_hits(hits, Status::clip, lane, result);
        }
        result.flags = any_flags();
        result.steps = result.fetches = any_count();
        store_prism(io, ray, result);
    }
};

}  // namespace quadrel
