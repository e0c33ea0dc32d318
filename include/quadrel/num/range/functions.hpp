// The functions of num/ on ranges of one lane: what an implementation may give for any argument in
// the range, within its permitted errors. Functions that follow from others inherit their errors.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/num/range/ranged.hpp"

namespace quadrel {

namespace range_detail {

/// num/'s own functions on double are within two units of the exact value.
inline RealInterval near(double low, double high) {
    const auto off = [](double x) { return std::fabs(x) * 0x1p-50 + 0x1p-1000; };
    return {low - off(low), high + off(high)};
}

/// Both ends of a growing function.
template <class Function>
RealInterval growing(const RealInterval& x, Function function) {
    return near(function(x.lo), function(x.hi));
}

}  // namespace range_detail

// ---- Without errors of their own ----------------------------------------------------------------

inline Ranged min(const Ranged& a, const Ranged& b) {
    const RealInterval x = a.range(), y = b.range();
    if (!a.is_bounded() && x.lo != x.hi) return Ranged::anything();
    if (!b.is_bounded() && y.lo != y.hi) return Ranged::anything();
    if (x.hi <= y.lo) return a;
    if (y.hi < x.lo) return b;
    return Ranged(std::min(x.lo, y.lo), std::min(x.hi, y.hi));
}
inline Ranged max(const Ranged& a, const Ranged& b) { return -min(-a, -b); }
inline Ranged abs(const Ranged& a) {
    const RealInterval x = a.range();
    if (x.lo >= 0) return a;
    if (x.hi <= 0) return -a;
    return {0, x.magnitude()};
}
inline Ranged copysign(const Ranged& a, const Ranged& b) {
    const Ranged size = abs(a);
    const RealInterval sign = b.range();
    if (sign.lo > 0) return size;
    if (sign.hi < 0) return -size;
    const double most = size.range().hi;
    return {-most, most};
}
/// All that either may be.
inline Ranged join(const Ranged& a, const Ranged& b) { return hull(a.range(), b.range()); }
inline bool same(const Ranged& a, const Ranged& b) {
    return a.lo == b.lo && a.hi == b.hi && a.terms == b.terms && a.mass == b.mass &&
           a.named == b.named && a.alternative == b.alternative && a.part[0] == b.part[0] &&
           a.part[1] == b.part[1] && a.part[2] == b.part[2];
}

// ---- Roots --------------------------------------------------------------------------------------

inline Ranged sqrt(const Ranged& a) {
    const RealInterval x = a.range();
    if (!a.is_bounded() || x.lo < 0) return Ranged::anything();
    return range_detail::rounded(
        {std::max(next_down(std::sqrt(x.lo)), 0.0), x.hi == 0 ? 0 : next_up(std::sqrt(x.hi))},
        range_detail::budget().square_root);
}
inline Ranged inversesqrt(const Ranged& a) {
    const RealInterval x = a.range();
    if (!a.is_bounded() || x.lo <= 0) return Ranged::anything();
    const RealInterval root{next_down(std::sqrt(x.lo)), next_up(std::sqrt(x.hi))};
    return range_detail::number(
        range_detail::rounded(RealInterval(1) / root, range_detail::budget().inverse_root));
}

// ---- Powers and logarithms ----------------------------------------------------------------------

namespace range_detail {
/// e^x or 2^x of a range, with an error of so many units and as many more a unit of |x|.
template <class Function>
Ranged power(const Ranged& a, double units, double slope, Function function) {
    if (!a.is_bounded()) return Ranged::anything();
    const RealInterval x = a.range();
    if (x.hi > 1100) return Ranged::anything();
    return number(rounded(growing(x, function), units + slope * x.magnitude()));
}
/// A logarithm of a range: by its units outside of [1/2, 2], absolute inside.
template <class Function>
Ranged logarithm(const Ranged& a, double units, Function function) {
    const RealInterval x = a.range();
    if (!a.is_bounded() || x.lo <= 0) return Ranged::anything();
    const ErrorBudget& errors = budget();
    RealInterval result = growing(x, function);
    if (x.lo < 0.5 || x.hi > 2) result = rounded(result, units);
    if (x.lo <= 2 && x.hi >= 0.5 && errors.log2_absolute > 0)
        result = widened(result, errors.log2_absolute);
    return flushed(result);
}
}  // namespace range_detail

inline Ranged exp2(const Ranged& a) {
    const ErrorBudget& errors = range_detail::budget();
    return range_detail::power(a, errors.exp2, errors.exp2_slope, [](double x) { return exp2(x); });
}
inline Ranged exp(const Ranged& a) {
    const ErrorBudget& errors = range_detail::budget();
    return range_detail::power(a, errors.exp, errors.exp_slope, [](double x) { return exp(x); });
}
inline Ranged log2(const Ranged& a) {
    return range_detail::logarithm(a, range_detail::budget().log2,
                                   [](double x) { return log2(x); });
}
inline Ranged log(const Ranged& a) {
    return range_detail::logarithm(a, range_detail::budget().log, [](double x) { return log(x); });
}

/// 2^(y log2 x). Nothing is promised for x < 0, nor for x = 0 with y <= 0.
inline Ranged pow(const Ranged& a, const Ranged& b) {
    const RealInterval x = a.range(), y = b.range();
    if (!a.is_bounded() || !b.is_bounded() || x.lo < 0) return Ranged::anything();
    const bool exact = range_detail::budget().unit == 0;
    if (x.lo > 0) {
        if (!exact) return exp2(b * log2(a));
        // Growing or falling in each argument: an end is at a corner.
        double low = std::numeric_limits<double>::infinity(), high = 0;
        for (const double base : {x.lo, x.hi})
            for (const double power : {y.lo, y.hi}) {
                const double value = pow(base, power);
                low = std::min(low, value);
                high = std::max(high, value);
            }
        return range_detail::number(range_detail::near(low, high));
    }
    if (y.lo <= 0) return Ranged::anything();
    if (x.hi == 0) return 0;
    const Ranged above = pow(Ranged(x.hi, x.hi), b);
    return {0, above.range().hi};
}

// ---- Angles -------------------------------------------------------------------------------------

namespace range_detail {
/// sin over a range; `turn` of a quarter turn is added to the argument: 0 sine, 1 cosine.
inline Ranged wave(const Ranged& a, int quarter) {
    if (!a.is_bounded()) return Ranged::anything();
    const RealInterval x = a.range();
    const ErrorBudget& errors = budget();
    if (errors.sine == std::numeric_limits<double>::infinity()) return Ranged::anything();
    const double limit = errors.sine_limit > 0 ? errors.sine_limit : 0x1p20;
    if (x.magnitude() > limit) return errors.unit > 0 ? Ranged::anything() : Ranged(-1, 1);
    const auto value = [&](double at) { return quarter == 0 ? sin(at) : cos(at); };
    const double first = value(x.lo), last = value(x.hi);
    RealInterval result = near(std::min(first, last), std::max(first, last));
    // A crest (trough) lies at quarter turns 1 (3), counted from the sine's zero, modulo 4.
    const double per_radian = 0x1.45f306dc9c883p-1, margin = 1e-9;
    const double from = x.lo * per_radian + quarter - margin,
                 to = x.hi * per_radian + quarter + margin;
    const auto meets = [&](double crest) {
        return floor((to - crest) / 4) > floor((from - crest) / 4) || to - from >= 4;
    };
    if (meets(1)) result.hi = 1;
    if (meets(3)) result.lo = -1;
    return widened(result, errors.sine);
}
}  // namespace range_detail

inline Ranged sin(const Ranged& a) { return range_detail::wave(a, 0); }
inline Ranged cos(const Ranged& a) { return range_detail::wave(a, 1); }
inline Ranged tan(const Ranged& a) { return sin(a) / cos(a); }
namespace range_detail {
/// The angle of a slope.
inline Ranged angle(const RealInterval& slope) {
    const double units = budget().arctangent;
    if (units == std::numeric_limits<double>::infinity()) return Ranged::anything();
    return rounded(growing(slope, [](double x) { return atan(x); }), units);
}
}  // namespace range_detail

inline Ranged atan(const Ranged& a) {
    return a.is_bounded() ? range_detail::angle(a.range()) : Ranged::anything();
}
/// Where x is above 0; elsewhere nothing is said.
inline Ranged atan2(const Ranged& y, const Ranged& x) {
    const RealInterval run = x.range(), rise = y.range();
    if (!x.is_bounded() || !y.is_bounded() || run.lo <= 0) return Ranged::anything();
    return range_detail::angle(rise / run);
}
inline Ranged asin(const Ranged& a) {
    const RealInterval x = a.range();
    if (range_detail::budget().unit > 0 || x.lo < -1 || x.hi > 1) return Ranged::anything();
    return range_detail::growing(x, [](double t) { return asin(t); });
}
inline Ranged acos(const Ranged& a) {
    const RealInterval x = a.range();
    if (range_detail::budget().unit > 0 || x.lo < -1 || x.hi > 1) return Ranged::anything();
    const RealInterval falling = range_detail::near(acos(x.hi), acos(x.lo));
    return falling;
}

}  // namespace quadrel
