// Intervals of doubles that are sure to hold the exact result, and as tight as can be: where an
// operation is exact, nothing is added. Directions come from the operation's rounding error, which
// double itself can tell (Knuth's TwoSum; the rest of a product or quotient by fma, which is
// correctly rounded on any CPU), never from the CPU's rounding mode.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace quadrel {

/// The next double upwards; infinity stays.
inline double next_up(double x) {
    if (!(x < std::numeric_limits<double>::infinity())) return x;
    const auto bits = std::bit_cast<std::int64_t>(x);
    if (x == 0) return std::numeric_limits<double>::denorm_min();
    return std::bit_cast<double>(bits + (x > 0 ? 1 : -1));
}
inline double next_down(double x) { return -next_up(-x); }

/// From lo to hi, both included.
struct RealInterval {
    double lo, hi;

    RealInterval() = default;
    RealInterval(double x) : lo(x), hi(x) {}
    RealInterval(double low, double high) : lo(low), hi(high) {}

    bool is_point() const { return lo == hi; }
    bool has_zero() const { return lo <= 0 && hi >= 0; }
    double middle() const { return is_point() ? lo : lo + (hi - lo) / 2; }
    double width() const { return hi - lo; }
    double magnitude() const { return std::max(std::fabs(lo), std::fabs(hi)); }
};

namespace interval_detail {
/// Below, the rest of a product may not be a double.
inline constexpr double least_product = 0x1p-900;

/// A rounded sum, and what is missing to the exact one.
struct Sum {
    double value, missing;

    double lower() const { return missing < 0 ? next_down(value) : value; }
    double upper() const { return missing > 0 ? next_up(value) : value; }
};
inline Sum sum(double a, double b) {
    const double s = a + b, of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
}
inline double product_below(double a, double b) {
    const double p = a * b;
    if (a == 0 || b == 0) return 0;
    if (!(std::fabs(p) > least_product)) return next_down(p);
    return std::fma(a, b, -p) < 0 ? next_down(p) : p;
}
inline double product_above(double a, double b) { return -product_below(-a, b); }
inline double quotient_below(double a, double b) {
    const double q = a / b;
    if (a == 0) return 0;
    if (!(std::fabs(q) > least_product) || !(std::fabs(a) > least_product)) return next_down(q);
    const double rest = std::fma(-q, b, a);
    return rest != 0 && (rest < 0) == (b > 0) ? next_down(q) : q;
}
inline double quotient_above(double a, double b) { return -quotient_below(-a, b); }
}  // namespace interval_detail

inline RealInterval operator-(RealInterval a) { return {-a.hi, -a.lo}; }
inline RealInterval operator+(RealInterval a, RealInterval b) {
    const interval_detail::Sum low = interval_detail::sum(a.lo, b.lo);
    if (a.is_point() && b.is_point()) return {low.lower(), low.upper()};
    return {low.lower(), interval_detail::sum(a.hi, b.hi).upper()};
}
inline RealInterval operator-(RealInterval a, RealInterval b) { return a + -b; }
inline RealInterval operator*(RealInterval a, RealInterval b) {
    using namespace interval_detail;
    if (a.is_point() && b.is_point()) return {product_below(a.lo, b.lo), product_above(a.lo, b.lo)};
    if (b.is_point()) std::swap(a, b);
    if (a.is_point()) {
        if (a.lo >= 0) return {product_below(a.lo, b.lo), product_above(a.lo, b.hi)};
        return {product_below(a.lo, b.hi), product_above(a.lo, b.lo)};
    }
    return {std::min({product_below(a.lo, b.lo), product_below(a.lo, b.hi),
                      product_below(a.hi, b.lo), product_below(a.hi, b.hi)}),
            std::max({product_above(a.lo, b.lo), product_above(a.lo, b.hi),
                      product_above(a.hi, b.lo), product_above(a.hi, b.hi)})};
}
/// b does not hold 0.
inline RealInterval operator/(RealInterval a, RealInterval b) {
    using namespace interval_detail;
    if (a.is_point() && b.is_point())
        return {quotient_below(a.lo, b.lo), quotient_above(a.lo, b.lo)};
    return {std::min({quotient_below(a.lo, b.lo), quotient_below(a.lo, b.hi),
                      quotient_below(a.hi, b.lo), quotient_below(a.hi, b.hi)}),
            std::max({quotient_above(a.lo, b.lo), quotient_above(a.lo, b.hi),
                      quotient_above(a.hi, b.lo), quotient_above(a.hi, b.hi)})};
}
inline RealInterval hull(RealInterval a, RealInterval b) {
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

}  // namespace quadrel
