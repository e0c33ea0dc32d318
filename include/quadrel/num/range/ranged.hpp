// Ranged: what an implementation may have for a number, as a range of doubles that is sure to hold
// it, whatever of its permitted errors (error_budget.hpp) it makes.
//
// Three things are kept beside the ends, so that ranges stay narrow:
//   * Sums may be added in any order. A sum of n terms t_i is off by no more than (n - 1) u
//   sum|t_i|
//     in each of them, so it is kept exact, with n and sum|t_i|, until it is used by anything else.
//     A product or quotient is off by its own error each time, in whatever order; what a fused
//     multiply-add leaves out is one of these errors.
//   * Interpolated values share errors: those of the triangle's vertices, which are the same in all
//     lanes. They are named, up to three to a value, each within [-1, 1], and cancel in
//     differences.
//   * A number that may be NaN, or infinite, or was never bounded, is `anything`.
// And of a number that an undecided select has chosen, which part of the range is that of what was
// not chosen yet, until it is used by anything else: a later select may rule it out.
// With a budget of 0 all this is interval arithmetic in double (interval.hpp).
#pragma once

#include "quadrel/num/range/context.hpp"
#include "quadrel/num/range/interval.hpp"

namespace quadrel {

struct Ranged {
    double lo, hi;             ///< of the sum so far, without its errors and the named ones
    double mass;               ///< sum of the magnitudes of its terms
    double terms;              ///< 1: no sum
    double part[3];            ///< of the named errors
    std::int32_t named;        ///< their group; 0: none
    std::int32_t unit;         ///< which component of which unit vector (geometry.hpp); 0: of none
    std::int32_t alternative;  ///< RangeContext's, of this run; 0: none

    Ranged() = default;
    /// A constant or an input: where arithmetic is float32's, rounded to it.
    Ranged(double x);
    /// Anything from `low` to `high`; not finite: anything.
    Ranged(double low, double high)
        : lo(low),
          hi(high),
          mass(RealInterval(low, high).magnitude()),
          terms(1),
          part{},
          named(0),
          unit(0),
          alternative(0) {
        if (!(low <= high) || !(mass < std::numeric_limits<double>::infinity())) *this = anything();
    }
    Ranged(const RealInterval& range) : Ranged(range.lo, range.hi) {}

    static Ranged anything() {
        Ranged result;
        result.lo = -std::numeric_limits<double>::infinity();
        result.hi = std::numeric_limits<double>::infinity();
        result.mass = result.hi;
        result.terms = 1;
        result.part[0] = result.part[1] = result.part[2] = 0;
        result.named = result.unit = result.alternative = 0;
        return result;
    }
    bool is_bounded() const {
        return lo > -std::numeric_limits<double>::infinity() &&
               hi < std::numeric_limits<double>::infinity();
    }
    bool is_null() const { return lo == 0 && hi == 0 && named == 0; }

    /// All that the number may be.
    RealInterval range() const;
};

namespace range_detail {

inline const ErrorBudget& budget() { return range_context().budget; }

/// The next float32 that is not above x.
inline double float_below(double x) {
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
inline double float_above(double x) { return -float_below(-x); }

inline constexpr double least_normal = 0x1p-126, least_denormal = 0x1p-149;

/// What may be flushed may be 0.
inline RealInterval flushed(RealInterval a) {
    if (budget().flushes_denormals && a.lo < least_normal && a.hi > -least_normal)
        return {std::min(a.lo, 0.0), std::max(a.hi, 0.0)};
    return a;
}

/// Moved outwards by so much.
inline RealInterval widened(RealInterval a, double by) {
    return {next_down(a.lo - by), next_up(a.hi + by)};
}

/// A result that is off by up to `ulps` units of its own.
inline RealInterval rounded(RealInterval a, double ulps) {
    const double part = ulps * 0x1p-23;
    if (part == 0) return a;
    const double tiny = ulps * least_denormal;
    return flushed({next_down(a.lo - (std::fabs(a.lo) * part + tiny)),
                    next_up(a.hi + (std::fabs(a.hi) * part + tiny))});
}

/// Numbers that float32 does not hold are infinite there.
inline Ranged number(RealInterval a) {
    const double largest = budget().unit > 0 ? double(std::numeric_limits<float>::max())
                                             : std::numeric_limits<double>::max();
    return a.lo >= -largest && a.hi <= largest ? Ranged(a.lo, a.hi) : Ranged::anything();
}

inline double named_errors(const Ranged& a) {
    if (a.named == 0) return 0;
    return (std::fabs(a.part[0]) + std::fabs(a.part[1]) + std::fabs(a.part[2])) * (1 + 0x1p-50);
}

/// What two finite sums are together. Of one with named errors of its own, b's are taken in.
inline Ranged sum(const Ranged& a, Ranged b) {
    if (a.named != 0 && b.named != 0 && a.named != b.named) {
        const RealInterval taken = widened({b.lo, b.hi}, named_errors(b));
        b.lo = taken.lo;
        b.hi = taken.hi;
        b.named = 0;
        b.part[0] = b.part[1] = b.part[2] = 0;
    }
    const RealInterval ends = RealInterval(a.lo, a.hi) + RealInterval(b.lo, b.hi);
    Ranged result(ends);
    if (!result.is_bounded()) return result;
    result.mass = (a.mass + b.mass) * (1 + 0x1p-50);
    // In some order an implementation's sum may overflow.
    if (budget().unit > 0 && result.mass > std::numeric_limits<float>::max())
        return Ranged::anything();
    result.terms = a.terms + b.terms;
    result.named = a.named != 0 ? a.named : b.named;
    if (result.named == 0) return result;
    double slack = 0;
    for (int i = 0; i < 3; ++i) {
        result.part[i] = a.part[i] + b.part[i];
        slack += (std::fabs(a.part[i]) + std::fabs(b.part[i])) * 0x1p-48;
    }
    result.lo = next_down(result.lo - slack);
    result.hi = next_up(result.hi + slack);
    return result;
}

inline Ranged negated(const Ranged& a) {
    Ranged result = a;
    result.alternative = 0;
    result.lo = -a.hi;
    result.hi = -a.lo;
    for (double& part : result.part) part = -part;
    return result;
}

/// By a power of two: nothing is rounded, unless it leaves float32's normal numbers.
inline Ranged scaled(const Ranged& a, double factor) {
    Ranged result = factor < 0 ? negated(a) : a;
    if (std::fabs(factor) != 1) result.unit = 0;
    result.alternative = 0;
    const double by = std::fabs(factor);
    result.lo *= by;
    result.hi *= by;
    result.mass *= by;
    for (double& part : result.part) part *= by;
    return result;
}

/// Whether products with it are exact.
inline bool is_power_of_two(const Ranged& a) {
    constexpr std::uint64_t fraction = (std::uint64_t(1) << 52) - 1;
    return a.lo == a.hi && a.named == 0 && a.terms == 1 && std::fabs(a.lo) >= 0x1p-60 &&
           std::fabs(a.lo) <= 0x1p60 && (std::bit_cast<std::uint64_t>(a.lo) & fraction) == 0;
}
inline bool stays_normal(const Ranged& a) {
    return (a.lo > 0x1p-60 || a.hi < -0x1p-60 || a.is_null()) && a.mass < 0x1p60;
}

}  // namespace range_detail

inline Ranged::Ranged(double x) : Ranged(x, x) {
    const bool infinite = std::fabs(x) == std::numeric_limits<double>::infinity();
    if (infinite) lo = hi = x;  // a bound that nothing reaches
    if (range_detail::budget().unit == 0 || !is_bounded()) return;
    const RealInterval r =
        range_detail::flushed({range_detail::float_below(x), range_detail::float_above(x)});
    *this = Ranged(r.lo, r.hi);
}

inline RealInterval Ranged::range() const {
    using namespace range_detail;
    if (!is_bounded()) return {lo, hi};
    RealInterval all(lo, hi);
    const double step = budget().unit;
    if (terms > 2 && step > 0)
        all = flushed(widened(all, (terms - 1) * (step * (1 + 0x1p-40) * mass + least_normal)));
    if (named != 0) all = widened(all, named_errors(*this));
    if (terms == 2 && step > 0) all = flushed({float_below(all.lo), float_above(all.hi)});
    return all;
}

inline Ranged operator-(const Ranged& a) { return range_detail::negated(a); }
inline Ranged operator+(const Ranged& a, const Ranged& b) {
    if (!a.is_bounded() || !b.is_bounded()) return Ranged::anything();
    if (a.is_null()) return b;
    if (b.is_null()) return a;
    return range_detail::sum(a, b);
}
inline Ranged operator-(const Ranged& a, const Ranged& b) { return a + -b; }
inline Ranged operator*(const Ranged& a, const Ranged& b) {
    using namespace range_detail;
    if (!a.is_bounded() || !b.is_bounded()) return Ranged::anything();
    if (a.is_null() || b.is_null()) return 0;
    if (is_power_of_two(a) && stays_normal(b)) return scaled(b, a.lo);
    if (is_power_of_two(b) && stays_normal(a)) return scaled(a, b.lo);
    return number(rounded(a.range() * b.range(), budget().unit > 0 ? 1 : 0));
}
inline Ranged operator/(const Ranged& a, const Ranged& b) {
    using namespace range_detail;
    if (!a.is_bounded() || !b.is_bounded()) return Ranged::anything();
    const RealInterval by = b.range();
    const ErrorBudget& errors = budget();
    const double least = by.has_zero() ? 0 : std::min(std::fabs(by.lo), std::fabs(by.hi));
    if (least == 0) return Ranged::anything();
    if (errors.unit > 0 && (least < least_normal || by.magnitude() > 0x1p126))
        return Ranged::anything();
    return number(rounded(a.range() / by, errors.division));
}

}  // namespace quadrel
