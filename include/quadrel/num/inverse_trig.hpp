// atan2, atan, asin and acos. Largest error measured: see math.hpp.
#pragma once

#include "quadrel/num/double_word.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/polynomial.hpp"

namespace quadrel {

namespace constants {
template <class T>
inline constexpr WordPair<T> quarter_pi{};
template <>
inline constexpr WordPair<float> quarter_pi<float>{0x1.921fb6p-1f, -0x1.777a5cp-26f};
template <>
inline constexpr WordPair<double> quarter_pi<double>{0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55};
template <class T>
inline constexpr T tan_eighth_pi = static_cast<T>(0x1.a827999fcef32p-2);

/// (atan(q) / q - 1) / z with z = q^2 on |q| <= tan(pi / 8), by interpolation at the Chebyshev
/// nodes.
template <class T>
inline constexpr std::array<T, 1> atan_tail{};
template <>
inline constexpr std::array<float, 5> atan_tail<float>{
    -0x1.555554p-2f, 0x1.99972ep-3f, -0x1.241fe6p-3f, 0x1.b8099p-4f, -0x1.082f6cp-4f};
template <>
inline constexpr std::array<double, 12> atan_tail<double>{
    -0x1.5555555555555p-2, 0x1.9999999999952p-3, -0x1.249249248d739p-3, 0x1.c71c71c2fc236p-4,
    -0x1.745d165c497f3p-4, 0x1.3b1392a9c2d8bp-4, -0x1.110e84aa36d9dp-4, 0x1.e199c62156609p-5,
    -0x1.ac7858539e493p-5, 0x1.74d3a7b43351ap-5, -0x1.1b1992aa413c9p-5, 0x1.0a997ba33c1dbp-6};
}  // namespace constants

/// Two magnitudes with the ratio of the given ones, 0 < larger, neither so large nor so small that
/// a product of theirs leaves the type's range. The ratio is 1 of two infinities, 0 of two zeros.
template <Number F>
struct MagnitudePair {
    F smaller;
    F larger;
};

template <Number F>
MagnitudePair<F> normalized_pair(F smaller, F larger) {
    using T = Scalar<F>;
    using Limits = std::numeric_limits<T>;
    const T up = static_cast<T>(1LL << Limits::digits);
    const Mask<F> huge = larger > F(Limits::max() / (up * up));
    const Mask<F> tiny = larger < F(Limits::min() * up * up * up);
    const F scale = select(huge, F(T(1) / up), select(tiny, F(up * up * up), F(1)));
    const F infinity = F(Limits::infinity());
    const Mask<F> infinite = larger == infinity;
    const F ratio = select(smaller == infinity, F(1), F(0));
    return {select(infinite, ratio, smaller * scale),
            select(infinite | (larger == F(0)), F(1), larger * scale)};
}

/// The angle of (x, y) from the positive x axis in radians, in [-pi, pi]; y's sign bit is the
/// result's. As IEEE 754: (+-0, +0 or positive) gives +-0, (+-0, -0 or negative) +-pi, infinities
/// the limit, both infinite the diagonal; NaN in either gives NaN.
template <Number F>
F atan2(F y, F x) {
    using T = Scalar<F>;
    const F ax = abs(x);
    const F ay = abs(y);
    const Mask<F> steep = ay > ax;
    const Mask<F> left = copysign(F(1), x) < F(0);
    const auto [small, large] = normalized_pair(select(steep, ax, ay), select(steep, ay, ax));

    // atan(small / large), about pi / 4 where the ratio is above tan(pi / 8).
    const Mask<F> centred = small > large * F(constants::tan_eighth_pi<T>);
    const F turn = select(centred, large, F(0));
    const DoubleWord<F> q =
        divide(two_sum(small, -turn), two_sum(large, select(centred, small, F(0))));
    const F z = q.hi * q.hi;
    const F tail = q.hi * (z * polynomial(z, constants::atan_tail<T>)) + q.lo * (F(1) - z);

    // The octants: how many quarters of pi to add, and in which direction the angle grows.
    const F octant = select(centred, F(1), F(0));
    const F in_quadrant = select(steep, F(2) - octant, octant);
    const F quarters = select(left, F(4) - in_quadrant, in_quadrant);
    const F direction = select(steep, F(-1), F(1)) * select(left, F(-1), F(1));
    const DoubleWord<F> base = multiply(broadcast<F>(constants::quarter_pi<T>), quarters);
    const DoubleWord<F> sum = two_sum(base.hi, direction * q.hi);
    const F angle = sum.hi + (sum.lo + (base.lo + direction * tail));
    return select((x == x) & (y == y), copysign(angle, y), x + y);
}

/// The angle in [-pi/2, pi/2] whose tangent is x.
template <Number F>
F atan(F x) {
    return atan2(x, F(1));
}
/// The angle in [-pi/2, pi/2] whose sine is x; NaN for |x| > 1.
template <Number F>
F asin(F x) {
    return atan2(x, sqrt((F(1) - x) * (F(1) + x)));
}
/// The angle in [0, pi] whose cosine is x; NaN for |x| > 1.
template <Number F>
F acos(F x) {
    return atan2(sqrt((F(1) - x) * (F(1) + x)), x);
}

}  // namespace quadrel
