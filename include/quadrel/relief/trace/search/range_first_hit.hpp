// The first hits of all rays of a range: what an exact search may give, however it gets there. For
// rows that walk over cells, nodes or cones of cells: their state is whole numbers, of which ranges
// know little, and their result is known without it.
//
// Parts of s are halved until one lies below the rays, or is short. Over a part all rays are in a
// box; the least and the greatest height in it say whether one of them may meet the field there,
// and whether all of them have met it by its end. Positions and heights are off by some roundings
// of float32 beside that, as far as a search may be that finds the hits up to rounding.
#pragma once

#include "quadrel/quad/promises.hpp"
#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

namespace range_detail {

/// More parts of s than this are taken together.
inline constexpr int most_parts = 8;
inline constexpr int most_ends = 9;  ///< and past all of them

class FirstHits {
  public:
    /// `blocks`: each texel a box. Otherwise bilinear patches between centres; level 0 either way.
    FirstHits(const SampledTexture& map, bool blocks, const oracle::RayRange& rays)
        : map_(map),
          texels_(map, 0),
          blocks_(blocks),
          x_{rays.u, rays.Ku, texels_.width(), rays.s_polygon},
          y_{rays.v, rays.Kv, texels_.height(), rays.s_polygon} {
        const double speed = std::max(x_.speed(), y_.speed());
        const double box = std::max(x_.width(), y_.width());
        known_ = speed < most_texels_crossed && box < most_texels_crossed;
        if (!known_) return;
        shortest_ = std::clamp(std::max(1.0 / 64, box / 8) / speed, 0x1p-20, 0x1p-14);
        const RealInterval start = heights(0, 0);
        const bool below = start.lo >= 1 + slack(start);
        if (below) add(0, 0);
        if (!below && !visit(0, 1)) passes_ = true;
    }

    /// False: nothing is known of the hits.
    bool known() const { return known_; }
    /// Where rays may meet the field first, from the top down.
    int parts() const { return count_; }
    const RealInterval& part(int k) const { return part_[k]; }
    /// Whether a ray may pass by the field altogether.
    bool passes() const { return passes_; }

    /// What a search may give for the field's height at hits in a part.
    RealInterval height_in(const RealInterval& s) const {
        const RealInterval reached(1 - s.hi, 1 - s.lo);
        RealInterval height = blocks_ ? heights(s.lo, s.hi) : reached;
        if (blocks_) height.lo = std::max(height.lo, reached.lo);
        if (s.lo == 0) height = hull(height, heights(0, 0));
        return widened(height, slack(height));
    }

  private:
    static constexpr double most_texels_crossed = 0x1p17;
    static constexpr int most_looks = 1 << 15;

    /// Positions along an axis, in texels.
    struct Axis {
        RealInterval start, rate;
        std::int32_t texels;
        double s_polygon;

        double speed() const { return rate.magnitude() * texels; }
        double width() const { return (start.width() + rate.width()) * texels; }
        RealInterval over(double from, double to) const {
            const RealInterval moved = RealInterval(from, to) - RealInterval(s_polygon);
            const double off = roundings() * (start.magnitude() + rate.magnitude());
            return widened(start + rate * moved, off) * RealInterval(texels);
        }
    };

    static double roundings() { return budget().unit > 0 ? 4 * budget().unit : 0x1p-48; }
    static double slack(const RealInterval& height) {
        return roundings() * (1 + std::min(height.magnitude(), 0x1p20));
    }

    RealInterval heights(double from, double to) const {
        const RealInterval x = x_.over(from, to), y = y_.over(from, to);
        TexelRange range = TexelRange::nothing();
        const bool seen =
            blocks_ ? include_nearest(range, texels_, x, y) : include_linear(range, texels_, x, y);
        return seen ? range.channel[0] : whole_map(map_).channel[0];
    }

    /// Whether all rays have met the field by `to`.
    bool visit(double from, double to) {
        const RealInterval all = heights(from, to);
        known_ = known_ && std::isfinite(all.width());
        if (!known_) return true;
        if (all.hi < 1 - to - slack(all)) return false;
        if (to - from > shortest_ && ++looks_ < most_looks) {
            const double middle = from + (to - from) / 2;
            return visit(from, middle) || visit(middle, to);
        }
        add(from, to);
        const RealInterval end = heights(to, to);
        return end.lo >= 1 - to + (to < 1 ? slack(end) : 0);
    }

    void add(double from, double to) {
        const bool meets = count_ > 0 && part_[count_ - 1].hi == from;
        if (meets || count_ == most_parts)
            part_[count_ - 1].hi = to;
        else
            part_[count_++] = {from, to};
    }

    const SampledTexture& map_;
    LevelTexels texels_;
    bool blocks_, known_ = true, passes_ = false;
    Axis x_, y_;
    double shortest_ = 1;
    RealInterval part_[most_parts];
    int count_ = 0, looks_ = 0;
};

/// One of `count` in a lane: the followed one takes one after another. -1: all together.
inline int one_of_parts(int count, int lane) {
    RangeContext& context = range_context();
    if (count == 1) return 0;
    if (context.followed != lane || context.together) {
        context.join(lane);
        return -1;
    }
    const int last = count - 1;
    for (int k = 0; k < most_ends; ++k) {
        if (k == last) break;
        const std::int32_t comparison = context.leave_open();
        if (comparison < 0 || context.decide(comparison)) return k;
    }
    return last;
}

/// From one status to another.
inline RangeInt::Lane statuses(Status first, Status last) {
    return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
}

/// Lane by lane, what a search may have found.
inline void find_first_hits(const SampledTexture& map, bool blocks, const SearchRay<Ranges>& ray,
                            int lane, SearchResult<Ranges>& result) {
    static_assert(Status::hit < Status::floor);
    const Ranged numbers[4] = {ray.uv.x.lane[lane], ray.uv.y.lane[lane], ray.K.x.lane[lane],
                               ray.K.y.lane[lane]};
    result.s.lane[lane] = Ranged(0.0, 1.0);
    result.h.lane[lane] = Ranged::anything();
    result.status.lane[lane] = {0, static_cast<std::int32_t>(allowed_end(Value::hit_status)) - 1};
    for (int k = 0; k < 4; ++k)
        if (!numbers[k].is_bounded()) return;
    const FirstHits hits(map, blocks,
                         {numbers[0].range(), numbers[1].range(), numbers[2].range(),
                          numbers[3].range(), ray.s_polygon});
    if (!hits.known()) return;
    // Behind the parts: nothing is met.
    const int ends = hits.parts() + (hits.passes() ? 1 : 0);
    const int which = one_of_parts(ends, lane);
    const bool all = which < 0, none = which == hits.parts();
    if (none || (all && hits.parts() == 0)) {
        result.s.lane[lane] = Ranged(1.0, 1.0);
        result.h.lane[lane] = Ranged(0.0, 0.0);
        result.status.lane[lane] = statuses(Status::floor, Status::floor);
        return;
    }
    RealInterval s = hits.part(std::max(which, 0));
    RealInterval h = hits.height_in(s);
    for (int k = 1; k < most_parts; ++k) {
        if (!all || k >= hits.parts()) continue;
        s = hull(s, hits.part(k));
        h = hull(h, hits.height_in(hits.part(k)));
    }
    const bool may_pass = all && hits.passes();
    if (may_pass) {
        s.hi = 1;
        h = hull(h, 0);
    }
    result.s.lane[lane] = Ranged(s);
    result.h.lane[lane] = Ranged(h);
    result.status.lane[lane] = statuses(Status::hit, may_pass ? Status::floor : Status::hit);
}

}  // namespace range_detail

/// A row that finds the first hit of a field up to rounding, on ranges.
template <class Row, bool blocks>
struct FirstHitOnRanges : Row {
    template <class Io>
    void operator()(Io& io, const typename Row::Params&) const {
        const SearchRay<Ranges> ray = search_ray(io);
        SearchResult<Ranges> result;
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const auto most = std::numeric_limits<std::int32_t>::max();
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state != RangeTruth::no)
                range_detail::find_first_hits(map, blocks, ray, lane, result);
            // What a search counts, and how it wraps or doubts, is not followed.
            result.flags.lane[lane] = {0, static_cast<std::int32_t>(HitFlag::end) - 1};
            result.steps.lane[lane] = result.fetches.lane[lane] = {0, most};
        }
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
