// Walks by cones on ranges: every step is taken for all positions that it may begin at
// (range_walk.hpp).
#pragma once

#include "quadrel/relief/trace/cone/range_baked_maps.hpp"

namespace quadrel {

/// Longer than any ray: where a ray may run along a border.
template <Number F>
requires std::same_as<F, Ranges> F fall_to_cell_border(const vec2<F>& uv, const vec2<F>& K,
                                                       const vec2<F>& size) {
    constexpr double for_ever = 1e6;
    const auto axis = [&](const Ranged& u, const Ranged& rate, const Ranged& texels) -> Ranged {
        const Ranged place = u * texels - Ranged(0.5), speed = rate * texels;
        if (!place.is_bounded() || !speed.is_bounded()) return Ranged(0.0, for_ever);
        const RealInterval x = place.range(), v = speed.range();
        double least = for_ever, most = 0;
        const auto include = [&](double from, double to) {
            least = std::min(least, from);
            most = std::max(most, std::min(to, for_ever));
        };
        if (v.hi > 0)
            include((std::floor(x.lo) == std::floor(x.hi) ? std::floor(x.hi) + 1 - x.hi : 0) / v.hi,
                    v.lo > 0 ? 1 / v.lo : for_ever);
        if (v.lo < 0)
            include((std::ceil(x.lo) == std::ceil(x.hi) ? x.lo - std::ceil(x.lo) + 1 : 0) / -v.lo,
                    v.hi < 0 ? 1 / -v.hi : for_ever);
        if (v.has_zero()) most = for_ever;
        // The next border may be that of the same cell at most.
        if (v.lo > 0 && std::floor(x.lo) == std::floor(x.hi))
            most = std::min(most, (std::floor(x.lo) + 1 - x.lo) / v.lo);
        if (v.hi < 0 && std::ceil(x.lo) == std::ceil(x.hi))
            most = std::min(most, (x.hi - std::ceil(x.hi) + 1) / -v.hi);
        return range_detail::rounded({std::min(least, most), most},
                                     range_detail::budget().unit > 0 ? 8 : 0);
    };
    F fall;
    for (int lane = 0; lane < 4; ++lane)
        fall.lane[lane] = min(axis(uv.x.lane[lane], K.x.lane[lane], size.x.lane[lane]),
                              axis(uv.y.lane[lane], K.y.lane[lane], size.y.lane[lane]));
    return max(fall, F(0)) + F(1e-5);
}

namespace range_detail {

/// A step by the cone under a piece of a lane's ray.
template <class Look, class Fall>
WalkStep cone_step(const SearchRay<Ranges>& ray, const Look& cone, const Fall& fall,
                   const RealInterval& tolerance, const RealInterval& piece, int lane) {
    const Aside aside;
    WalkStep step;
    const Ranges s = everywhere(piece);
    const vec2<Ranges> uv = ray.at(s);
    const Cone<Ranges> here = cone(only(lane), s, uv);
    Ranges gap = (Ranges(1) - s) - here.height;
    step.known = gap.lane[lane].is_bounded();
    if (!step.known) return step;
    const RealInterval of_gap = gap.lane[lane].range();
    step.height = here.height.lane[lane].range();
    step.ends = of_gap.lo <= tolerance.hi;
    step.goes_on = of_gap.hi > tolerance.lo;
    if (!step.goes_on) return step;
    gap.lane[lane] = Ranged(std::max(of_gap.lo, tolerance.lo), of_gap.hi);
    const Ranged to = min((s + fall(here, gap, uv)).lane[lane], Ranged(1.0, 1.0));
    step.known = to.is_bounded();
    if (step.known) step.to = {std::max(to.range().lo, piece.lo), std::min(to.range().hi, 1.0)};
    return step;
}

/// What halving the last step may come to in a lane: the end of a piece in which the field may be
/// reached, next to one in which it may not be.
template <class Look>
WalkPart bisected(const SearchRay<Ranges>& ray, const Look& cone, int times, const WalkPart& walk,
                  int lane) {
    constexpr int most_pieces = 256;
    const Aside aside;
    const double first = walk.from.lo, width = walk.s.hi - first;
    const double left = std::ldexp(width, -times) + 0x1p-40;
    const int pieces =
        static_cast<int>(std::clamp(width / (0.25 * left), 1.0, double(most_pieces)));
    WalkPart result{{walk.s.hi, walk.s.lo}, walk.from, walk.height};
    // The point above that is nearest, so far: the last step began at one.
    double above = walk.from.hi;
    for (int k = 0; k < pieces; ++k) {
        const RealInterval piece(first + width * k / pieces,
                                 k + 1 == pieces ? walk.s.hi : first + width * (k + 1) / pieces);
        const Ranges s = everywhere(piece);
        const Ranges height = cone(only(lane), s, ray.at(s)).height;
        const Ranged gap = ((Ranges(1) - s) - height).lane[lane];
        if (!gap.is_bounded()) return {{first, walk.s.hi}, walk.from, hull(walk.height, {0, 1})};
        if (gap.range().hi > 0) above = std::max(above, piece.hi);
        const bool reached = gap.range().lo <= 0 || piece.hi >= walk.s.lo;
        if (!reached || piece.lo > above + left) continue;
        const bool below = gap.range().hi <= 0 && piece.hi < walk.s.lo;
        const double last = below ? std::min(piece.hi, above + left) : piece.hi;
        result.s = {std::min(result.s.lo, piece.lo), std::max(result.s.hi, last)};
        result.height = hull(result.height, height.lane[lane].range());
    }
    if (result.s.lo > result.s.hi) result.s = walk.s;
    return result;
}

}  // namespace range_detail

/// Lane by lane, one of the ways that the walk may end.
template <Number F, class Look, class Fall>
requires std::same_as<F, Ranges> ConeWalk<F> walk_cones(const SearchRay<F>& ray, const Look& cone,
                                                        const Fall& fall, int most, F tolerance) {
    using namespace range_detail;
    static thread_local KnownWalks known;
    ConeWalk<F> walk(ray.active);
    RealInterval least_gap = tolerance.lane[0].range();
    // rounding_gap is a float's where arithmetic is.
    if (budget().unit > 0) least_gap.hi = std::max(least_gap.hi, double{rounding_gap<Quad<float>>});
    for (int lane = 0; lane < 4; ++lane) {
        walk.found.lane[lane] = false;
        if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
        const WalkEnds& ends = known.of(ray, lane, [&] {
            return walk_parts(most, finest_piece(ray, lane), [&](const RealInterval& piece) {
                return cone_step(ray, cone, fall, least_gap, piece, lane);
            });
        });
        const WalkOutcome outcome = outcome_of(ends, lane);
        walk.s.lane[lane] = Ranged(outcome.s);
        walk.previous.lane[lane] = Ranged(outcome.from);
        walk.result.h.lane[lane] = outcome.known ? Ranged(outcome.height) : Ranged::anything();
        walk.result.status.lane[lane] =
            outcome.known ? statuses(outcome.first, outcome.last) : any_status();
        walk.found.lane[lane] = !outcome.known || outcome.first != outcome.last
                                    ? RangeTruth(RangeTruth::perhaps)
                                    : RangeTruth(outcome.first == Status::hit);
    }
    walk.active = RangeMask(false);
    walk.result.s = walk.s;
    walk.result.steps = walk.result.fetches = any_count();
    return walk;
}

template <Number F, class Look>
requires std::same_as<F, Ranges>
void bisect_last_step(const SearchRay<F>& ray, const Look& cone, int times, ConeWalk<F>& walk) {
    using namespace range_detail;
    for (int lane = 0; lane < 4; ++lane) {
        const RangeTruth found = walk.found.lane[lane].known();
        if (found.state == RangeTruth::no || times == 0) continue;
        const Ranged& height = walk.result.h.lane[lane];
        const WalkPart last{walk.s.lane[lane].range(), walk.previous.lane[lane].range(),
                            height.is_bounded() ? height.range() : RealInterval(0, 1)};
        WalkPart part = bisected(ray, cone, times, last, lane);
        if (found.state != RangeTruth::yes) part = {hull(part.s, last.s), part.from, part.height};
        walk.result.s.lane[lane] = Ranged(part.s);
        if (height.is_bounded()) walk.result.h.lane[lane] = Ranged(part.height);
    }
}

}  // namespace quadrel
