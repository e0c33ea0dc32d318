// sin, cos and tan. Largest error measured: see math.hpp.
#pragma once

#include "quadrel/num/double_word.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/polynomial.hpp"

namespace quadrel {

namespace constants {
/// pi / 2 as an unevaluated sum.
template <class T>
inline constexpr std::array<T, 4> half_pi{};
template <>
inline constexpr std::array<float, 4> half_pi<float>{0x1.921fb6p+0f, -0x1.777a5cp-25f,
                                                     -0x1.ee59dap-50f, 0x1.98a2ep-77f};
template <>
inline constexpr std::array<double, 4> half_pi<double>{
    0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110, 0x1.4cf98e804177dp-164};
template <class T>
inline constexpr T two_over_pi = static_cast<T>(0x1.45f306dc9c883p-1);

/// 2^22 for float, 2^51 for double: where the spacing of the type reaches 1/2, while the multiple
/// of pi / 2 nearest to x is still an integer that the type holds.
template <class T>
inline constexpr T trig_limit = static_cast<T>(1LL << (std::numeric_limits<T>::digits - 2));

/// (sin(r) / r - 1) / z and (cos(r) - 1 + z / 2) / z^2 with z = r^2 on |r| <= 1.0005 pi / 4, by
/// interpolation at the Chebyshev nodes.
template <class T>
inline constexpr std::array<T, 1> sin_tail{};
template <>
inline constexpr std::array<float, 4> sin_tail<float>{-0x1.555556p-3f, 0x1.11110ep-7f,
                                                      -0x1.a013a4p-13f, 0x1.6dbcfcp-19f};
template <>
inline constexpr std::array<double, 7> sin_tail<double>{
    -0x1.5555555555555p-3,  0x1.111111111111p-7,   -0x1.a01a01a01992fp-13, 0x1.71de3a545f835p-19,
    -0x1.ae645410e9193p-26, 0x1.61217d923a998p-33, -0x1.ab16f5bc68a29p-41};
template <class T>
inline constexpr std::array<T, 1> cos_tail{};
template <>
inline constexpr std::array<float, 3> cos_tail<float>{0x1.555554p-5f, -0x1.6c12dp-10f,
                                                      0x1.9bd786p-16f};
template <>
inline constexpr std::array<double, 6> cos_tail<double>{
    0x1.5555555555555p-5,   -0x1.6c16c16c16963p-10, 0x1.a01a019f4ddfdp-16,
    -0x1.27e4fa16cc1bcp-22, 0x1.1eeb67d014ecep-29,  -0x1.907cd8f26aa3fp-37};
}  // namespace constants

/// x = quadrant * pi / 2 + remainder, modulo 2 pi; |remainder| <= pi / 4 and a little, quadrant 0,
/// 1, 2 or 3. Beyond constants::trig_limit, for infinities and for NaN as of x = 0.
template <Number F>
struct ReducedAngle {
    DoubleWord<F> remainder;
    F quadrant;
};

template <Number F>
ReducedAngle<F> reduce_angle(F x) {
    using T = Scalar<F>;
    const F angle = select(abs(x) <= F(constants::trig_limit<T>), x, F(0));
    // The nearest multiple of pi / 2; where the first product's rounding missed it, mended once.
    const F guess = round_even(angle * F(constants::two_over_pi<T>));
    const DoubleWord<F> near = two_product(guess, F(constants::half_pi<T>[0]));
    const F off = (angle - near.hi) - near.lo;
    const F turns = guess + round_even(off * F(constants::two_over_pi<T>));
    // Cody and Waite's reduction with exact products: whatever cancels, cancels exactly.
    DoubleWord<F> rest{angle, F(0)};
    const auto subtract = [&rest](F part) {
        const DoubleWord<F> sum = two_sum(rest.hi, -part);
        rest = {sum.hi, rest.lo + sum.lo};
    };
    for (const T part : constants::half_pi<T>) {
        const DoubleWord<F> product = two_product(turns, F(part));
        subtract(product.hi);
        subtract(product.lo);
    }
    const F quadrant = turns - F(4) * floor(turns * F(T(0.25)));
    return {two_sum(rest.hi, rest.lo), quadrant};
}

/// sin and cos of a remainder.
template <Number F>
F sin_of_remainder(DoubleWord<F> r) {
    const F z = r.hi * r.hi;
    const F cubic = r.hi * (z * polynomial(z, constants::sin_tail<Scalar<F>>));
    return r.hi + (cubic + r.lo * (F(1) - z * F(Scalar<F>(0.5))));
}
template <Number F>
F cos_of_remainder(DoubleWord<F> r) {
    const DoubleWord<F> z = two_product(r.hi, r.hi);
    const F half = F(Scalar<F>(0.5));
    const DoubleWord<F> sum = fast_two_sum(F(1), -z.hi * half);
    const F quartic = z.hi * z.hi * polynomial(z.hi, constants::cos_tail<Scalar<F>>);
    return sum.hi + (sum.lo + (quartic - (r.hi * r.lo + z.lo * half)));
}

/// value where x is finite, NaN elsewhere.
template <Number F>
F where_finite(F x, F value) {
    return select(is_finite(x), value, F(std::numeric_limits<Scalar<F>>::quiet_NaN()));
}

/// The sine of x radians. Beyond constants::trig_limit (4194304 for float, 2^51 for double), where
/// the type's spacing is a large part of a turn, x counts as 0. Infinities and NaN give NaN.
template <Number F>
F sin(F x) {
    const ReducedAngle<F> angle = reduce_angle(x);
    const Mask<F> odd = (angle.quadrant == F(1)) | (angle.quadrant == F(3));
    const F value =
        select(odd, cos_of_remainder(angle.remainder), sin_of_remainder(angle.remainder));
    const F turned = select(angle.quadrant >= F(2), -value, value);
    return where_finite(x, select(x == F(0), x, turned));  // keeps -0
}
/// The cosine of x radians, with sin's range.
template <Number F>
F cos(F x) {
    const ReducedAngle<F> angle = reduce_angle(x);
    const Mask<F> first = angle.quadrant == F(1);
    const Mask<F> odd = first | (angle.quadrant == F(3));
    const F value =
        select(odd, sin_of_remainder(angle.remainder), cos_of_remainder(angle.remainder));
    return where_finite(x, select(first | (angle.quadrant == F(2)), -value, value));
}
/// The tangent of x radians as the quotient of sine and cosine, with sin's range.
template <Number F>
F tan(F x) {
    const ReducedAngle<F> angle = reduce_angle(x);
    const F s = sin_of_remainder(angle.remainder);
    const F c = cos_of_remainder(angle.remainder);
    const Mask<F> odd = (angle.quadrant == F(1)) | (angle.quadrant == F(3));
    const F value = select(odd, -c, s) / select(odd, s, c);
    return where_finite(x, select(x == F(0), x, value));
}

/// Degrees to radians: x * (pi / 180), the factor rounded to the type.
template <Number F>
F radians(F degrees) {
    return degrees * F(static_cast<Scalar<F>>(0x1.1df46a2529d39p-6));
}
/// Radians to degrees: x * (180 / pi), the factor rounded to the type.
template <Number F>
F degrees(F radians) {
    return radians * F(static_cast<Scalar<F>>(0x1.ca5dc1a63c1f8p+5));
}

}  // namespace quadrel
