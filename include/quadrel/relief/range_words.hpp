// What the words of searches mean on ranges: every step is made, and a chord stays within its
// bracket. What other words mean there comes with it.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/quad/range_interpolate.hpp"
#include "quadrel/relief/frame/range_gram.hpp"
#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/near_surface.hpp"
#include "quadrel/texture/range/cube.hpp"

namespace quadrel {

template <Number F, class Height>
requires std::same_as<F, Ranges> Steps steps_near_surface(const Height&, const LatticeRays<F>&,
                                                          const Mask<F>&, int first, int last,
                                                          Before = Before::not_needed) {
    return steps<F>(first, last);
}
template <Number F, class Height>
requires std::same_as<F, Ranges> Steps steps_near_surface(const Height&, const SearchRay<F>&,
                                                          const Mask<F>&, F, int last,
                                                          Before = Before::not_needed) {
    return steps<F>(0, last);
}
template <Before before, class Along, class Position, class Heights>
class StepsOnCourse<Ranges, before, Along, Position, Heights> : public Steps {
  public:
    StepsOnCourse(const Along&, Position&, const Heights&, const RangeMask&, int first, int last,
                  const Ranges&)
        : Steps(first, last) {}
};

namespace range_detail {

/// Of a gap and an excess, neither below 0: gap / (gap + excess), and 0 where both are 0. It grows
/// with the gap and falls with the excess, so that each end has one of either.
inline RealInterval part_above(const Ranged& gap, const Ranged& excess) {
    if (!gap.is_bounded() || !excess.is_bounded()) return {0, 1};
    const RealInterval g = gap.range(), e = excess.range();
    const auto part = [](double above, double below) {
        return above + below > 0 ? above / (above + below) : 0;
    };
    const double least = std::max(g.lo, 0.0), most = std::max(g.hi, 0.0);
    const ErrorBudget& errors = budget();
    const RealInterval exact =
        near(part(least, std::max(e.hi, 0.0)), part(most, std::max(e.lo, 0.0)));
    const RealInterval all = rounded(exact, errors.unit > 0 ? errors.division + 1 : 0);
    return {std::clamp(all.lo, 0.0, 1.0), std::clamp(all.hi, 0.0, 1.0)};
}

/// `part` of the way from a to b, not beyond either.
inline RealInterval between(const RealInterval& a, const RealInterval& b,
                            const RealInterval& part) {
    const auto at = [&](double p) {
        return RealInterval(a.lo + p * (b.lo - a.lo), a.hi + p * (b.hi - a.hi));
    };
    const double off =
        (a.magnitude() + b.magnitude()) * (budget().unit > 0 ? 3 * budget().unit : 0x1p-48);
    const RealInterval all = widened(hull(at(part.lo), at(part.hi)), off);
    return {std::max(all.lo, std::min(a.lo, b.lo)), std::min(all.hi, b.hi)};
}

}  // namespace range_detail

/// The sample above is above, and the one below is at or below the surface: whatever their heights
/// may be, the chord meets the ray between them.
inline Ranges chord(const Bracket<Ranges>& b, const Ranges& weight_above = Ranges(1),
                    const Ranges& weight_below = Ranges(1)) {
    const Ranges gap = ((Ranges(1) - b.s_above) - b.h_above) * weight_above;
    const Ranges excess = (b.h_below - (Ranges(1) - b.s_below)) * weight_below;
    Ranges result(Ranged::anything());
    for (int i = 0; i < 4; ++i) {
        const Ranged &above = b.s_above.lane[i], &below = b.s_below.lane[i];
        if (!above.is_bounded() || !below.is_bounded()) continue;
        result.lane[i] = Ranged(range_detail::between(
            above.range(), below.range(), range_detail::part_above(gap.lane[i], excess.lane[i])));
    }
    return result;
}

}  // namespace quadrel
