// The first hits of all rays of a range: what an exact search may give, however it gets there. For
// rows that walk over cells, nodes or cones of cells: their state is whole numbers, of which ranges
// know little, and their result is known without it.
//
// Parts of s are halved until one lies below the rays, or is short. Over a part all rays are in a
// box; the least and the greatest height in it say whether one of them may meet the field there,
// and whether all of them have met it by its end. Positions and heights are off by some roundings
// of float32 beside that, as far as a search may be that finds the hits up to rounding.
#pragma once

#include <optional>

#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "quadrel/relief/trace/search/range_parts.hpp"
#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

namespace range_detail {

/// Positions of rays along an axis, in texels, as s goes from 0 to 1.
struct RayAxis {
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

    /// What positions and heights are off by, relative.
    static double roundings() { return budget().unit > 0 ? 4 * budget().unit : 0x1p-48; }
};

/// What a ray's height and the field's are off by.
inline double height_slack(const RealInterval& height) {
    return RayAxis::roundings() * (1 + std::min(height.magnitude(), 0x1p20));
}

/// The heights of the level-0 field in a box, in texels.
class FieldRange {
  public:
    FieldRange(const SampledTexture& map, oracle::Surface surface)
        : map_(map), texels_(map, 0), surface_(surface) {}

    const LevelTexels& texels() const { return texels_; }

    RealInterval operator()(const RealInterval& x, const RealInterval& y) const {
        TexelRange range = TexelRange::nothing();
        const bool seen = surface_ == oracle::Surface::block ? include_nearest(range, texels_, x, y)
                                                             : include_linear(range, texels_, x, y);
        if (!seen) return whole_map(map_).channel[0];
        // A triangle's plane is off the patch by up to a quarter of the patch's twist.
        const bool bilinear =
            surface_ == oracle::Surface::bilinear || surface_ == oracle::Surface::block;
        return bilinear ? range.channel[0] : widened(range.channel[0], twist(x, y) / 4);
    }

  private:
    /// The greatest |h00 - h10 - h01 + h11| of the cells that a box meets.
    double twist(const RealInterval& x, const RealInterval& y) const {
        double most = 0;
        for (double j = std::floor(y.lo - 0.5); j <= std::floor(y.hi - 0.5); ++j)
            for (double i = std::floor(x.lo - 0.5); i <= std::floor(x.hi - 0.5); ++i) {
                const auto h = [&](double a, double b) { return texels_.at(a, b).channel[0]; };
                most = std::max(
                    most, std::fabs((h(i, j) - h(i + 1, j)) - (h(i, j + 1) - h(i + 1, j + 1))));
            }
        return most;
    }

    const SampledTexture& map_;
    LevelTexels texels_;
    oracle::Surface surface_;
};

/// Whether a ray of a range may meet something in a part of its way.
enum class Meets { none, some, unknown };

/// Where the rays of a range may meet a solid first, from the top down: parts of their way from 0
/// to 1. `solid.meets(from, to)` is a Meets, `solid.holds_all(at)` whether all rays are in it
/// there. Parts shorter than `shortest` are not halved.
class FirstParts {
  public:
    template <class Solid>
    FirstParts(const Solid& solid, double shortest) : shortest_(shortest) {
        const bool inside = solid.holds_all(0);
        if (inside) add(0, 0);
        if (!inside && !visit(solid, 0, 1)) passes_ = true;
    }

    /// False: nothing is known of them.
    bool known() const { return known_; }
    int count() const { return count_; }
    const RealInterval& operator[](int k) const { return part_[k]; }
    /// Whether a ray may pass by altogether.
    bool passes() const { return passes_; }

  private:
    static constexpr int most_looks = 1 << 15;

    /// Whether all rays are inside at `to`.
    template <class Solid>
    bool visit(const Solid& solid, double from, double to) {
        const Meets here = solid.meets(from, to);
        known_ = known_ && here != Meets::unknown;
        if (!known_) return true;
        if (here == Meets::none) return false;
        if (to - from > shortest_ && ++looks_ < most_looks) {
            const double middle = from + (to - from) / 2;
            return visit(solid, from, middle) || visit(solid, middle, to);
        }
        add(from, to);
        return solid.holds_all(to);
    }

    void add(double from, double to) {
        const bool meets = count_ > 0 && part_[count_ - 1].hi == from;
        if (meets || count_ == most_parts)
            part_[count_ - 1].hi = to;
        else
            part_[count_++] = {from, to};
    }

    double shortest_;
    bool known_ = true, passes_ = false;
    RealInterval part_[most_parts];
    int count_ = 0, looks_ = 0;
};

/// The places of rays of a range, in texels.
struct RayPlaces {
    RayAxis x, y;

    double speed() const { return std::max(x.speed(), y.speed()); }
    double box() const { return std::max(x.width(), y.width()); }
    /// Whether the rays are as few and as short as can be gone through.
    bool are_short() const {
        constexpr double most_texels_crossed = 0x1p17;
        return speed() < most_texels_crossed && box() < most_texels_crossed;
    }
    /// How short parts of the way need be.
    double shortest() const {
        return std::clamp(std::max(1.0 / 64, box() / 8) / speed(), 0x1p-20, 0x1p-14);
    }
};

class FieldHits {
  public:
    FieldHits(const SampledTexture& map, oracle::Surface surface, const oracle::RayRange& rays)
        : field_(map, surface),
          blocks_(surface == oracle::Surface::block),
          at_{{rays.u, rays.Ku, field_.texels().width(), rays.s_polygon},
              {rays.v, rays.Kv, field_.texels().height(), rays.s_polygon}} {}

    const RayPlaces& places() const { return at_; }

    Meets meets(double from, double to) const {
        const RealInterval all = heights(from, to);
        if (!std::isfinite(all.width())) return Meets::unknown;
        return all.hi < 1 - to - height_slack(all) ? Meets::none : Meets::some;
    }
    /// The last height decides by itself.
    bool holds_all(double at) const {
        const RealInterval end = heights(at, at);
        return end.lo >= 1 - at + (at < 1 ? height_slack(end) : 0);
    }
    /// What a search may give for the field's height at hits in a part.
    RealInterval height_in(const RealInterval& s) const {
        const RealInterval reached(1 - s.hi, 1 - s.lo);
        RealInterval height = blocks_ ? heights(s.lo, s.hi) : reached;
        if (blocks_) height.lo = std::max(height.lo, reached.lo);
        if (s.lo == 0) height = hull(height, heights(0, 0));
        return widened(height, height_slack(height));
    }

  private:
    RealInterval heights(double from, double to) const {
        return field_(at_.x.over(from, to), at_.y.over(from, to));
    }

    FieldRange field_;
    bool blocks_;
    RayPlaces at_;
};

/// What a lane's search may have found of a solid: the hit is in one part or another; past all of
/// them there is none, which is `miss`. `solid.height_in(part)` is what it gives for the height.
/// `result` is left as it is where nothing is known.
template <class Solid>
void take_first_hits(const Solid& solid, Status miss, int lane, SearchResult<Ranges>& result) {
    if (!solid.places().are_short()) return;
    const FirstParts hits(solid, solid.places().shortest());
    if (!hits.known()) return;
    const int ends = hits.count() + (hits.passes() ? 1 : 0);
    const int which = one_of_parts(ends, lane);
    const bool all = which < 0, none = which == hits.count();
    if (none || (all && hits.count() == 0)) {
        result.s.lane[lane] = Ranged(1.0, 1.0);
        result.h.lane[lane] = Ranged(0.0, 0.0);
        result.status.lane[lane] = statuses(miss, miss);
        return;
    }
    RealInterval s = hits[std::max(which, 0)];
    RealInterval h = solid.height_in(s);
    for (int k = 1; all && k < hits.count(); ++k) {
        s = hull(s, hits[k]);
        h = hull(h, solid.height_in(hits[k]));
    }
    const bool may_pass = all && hits.passes();
    if (may_pass) {
        s.hi = 1;
        h = hull(h, 0);
    }
    result.s.lane[lane] = Ranged(s);
    result.h.lane[lane] = Ranged(h);
    result.status.lane[lane] = statuses(Status::hit, may_pass ? miss : Status::hit);
}

/// A lane's ray as intervals; nothing where it is not bounded.
inline std::optional<oracle::RayRange> ray_range(const SearchRay<Ranges>& ray, int lane) {
    const Ranged numbers[4] = {ray.uv.x.lane[lane], ray.uv.y.lane[lane], ray.K.x.lane[lane],
                               ray.K.y.lane[lane]};
    for (const Ranged& number : numbers)
        if (!number.is_bounded()) return std::nullopt;
    return oracle::RayRange{numbers[0].range(), numbers[1].range(), numbers[2].range(),
                            numbers[3].range(), ray.s_polygon};
}

/// Nothing is known of a lane's search.
inline void take_any_hit(int lane, SearchResult<Ranges>& result) {
    result.s.lane[lane] = Ranged(0.0, 1.0);
    result.h.lane[lane] = Ranged::anything();
    result.status.lane[lane] = any_status();
}

}  // namespace range_detail

/// A row that finds the first hit of a field up to rounding, on ranges.
template <class Row, oracle::Surface surface = oracle::Surface::bilinear>
struct FirstHitOnRanges : Row {
    template <class Io>
    void operator()(Io& io, const typename Row::Params&) const {
        const SearchRay<Ranges> ray = search_ray(io);
        SearchResult<Ranges> result;
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        for (int lane = 0; lane < 4; ++lane)
            if (ray.active.lane[lane].known().state != RangeTruth::no) find(map, ray, lane, result);
        result.flags = range_detail::any_flags();
        result.steps = result.fetches = range_detail::any_count();
        store_search(io, ray, result);
    }

  private:
    static void find(const SampledTexture& map, const SearchRay<Ranges>& ray, int lane,
                     SearchResult<Ranges>& result) {
        using namespace range_detail;
        take_any_hit(lane, result);
        if (const auto rays = ray_range(ray, lane))
            take_first_hits(FieldHits(map, surface, *rays), Status::floor, lane, result);
    }
};

}  // namespace quadrel
