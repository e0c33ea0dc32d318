// log2 and log. Largest error measured: see math.hpp.
#pragma once

#include "quadrel/num/exp.hpp"

namespace quadrel {

namespace constants {
template <class T>
inline constexpr WordPair<T> two_log2_e{2 * log2_e<T>.hi, 2 * log2_e<T>.lo};

template <class T>
inline constexpr WordPair<T> third{};
template <>
inline constexpr WordPair<float> third<float>{0x1.555556p-2f, -0x1.555556p-27f};
template <>
inline constexpr WordPair<double> third<double>{0x1.5555555555555p-2, 0x1.5555555555555p-56};

/// (atanh(s) / s - 1 - z / 3) / z^2 with z = s^2 on [0, 0.0296], by interpolation at the Chebyshev
/// nodes.
template <class T>
inline constexpr std::array<T, 1> atanh_tail{};
template <>
inline constexpr std::array<float, 4> atanh_tail<float>{0x1.99999ap-3f, 0x1.24929p-3f,
                                                        0x1.c6bfe2p-4f, 0x1.87b1eep-4f};
template <>
inline constexpr std::array<double, 8> atanh_tail<double>{
    0x1.999999999999ap-3, 0x1.2492492492527p-3, 0x1.c71c71c6e8f44p-4, 0x1.745d177c10ad9p-4,
    0x1.3b1395347c9ep-4,  0x1.1118e94969b8bp-4, 0x1.df75d14baa685p-5, 0x1.e077188742e3cp-5};

template <class T>
inline constexpr T sqrt_2 = static_cast<T>(0x1.6a09e667f3bcdp+0);
}  // namespace constants

/// log2 of a significand in [sqrt(1/2), sqrt(2)], to about 1.25 times the type's digits. Products
/// are 0 or at least a unit in the last place squared: m - 1 is one at least where it is not 0.
template <Number F>
DoubleWord<F> log2_of_significand(F m) {
    using T = Scalar<F>;
    using Product = OrdinaryProduct;
    // log2(m) = 2 / ln(2) * atanh(s) with s = (m - 1) / (m + 1).
    const DoubleWord<F> s = divide<Product>(DoubleWord<F>{m - F(1), F(0)}, two_sum(m, F(1)));
    const DoubleWord<F> z = multiply<Product>(s, s);
    const F tail = z.hi * polynomial(z.hi, constants::atanh_tail<T>);
    const DoubleWord<F> slope = fast_add(broadcast<F>(constants::third<T>), tail);
    const DoubleWord<F> ratio = fast_add(F(1), multiply<Product>(z, slope));
    return multiply<Product>(multiply<Product>(s, ratio), broadcast<F>(constants::two_log2_e<T>));
}

/// log2 |x| as a double word for |x| finite and not 0, denormals included; some finite number
/// otherwise.
template <Number F>
DoubleWord<F> log2_double_word(F x) {
    using T = Scalar<F>;
    constexpr int digits = std::numeric_limits<T>::digits;
    const F magnitude = abs(x);
    const Mask<F> denormal = magnitude < F(std::numeric_limits<T>::min());
    const F normal = select(denormal, magnitude * F(T(1LL << digits)), magnitude);
    const F m = significand(normal);
    const F e = exponent(normal) - select(denormal, F(T(digits)), F(0));
    const Mask<F> upper = m > F(constants::sqrt_2<T>);
    const F centred = select(upper, m * F(T(0.5)), m);
    return fast_add(select(upper, e + F(1), e), log2_of_significand(centred));
}

/// value, with what logarithms share: +-0 gives -inf, negative numbers and NaN give NaN, +inf +inf.
template <Number F>
F with_logarithm_domain(F x, F value) {
    using Limits = std::numeric_limits<Scalar<F>>;
    const F infinity = F(Limits::infinity());
    const F finite = select(x == infinity, infinity, value);
    const F defined = select(x == F(0), -infinity, finite);
    return select(x >= F(0), defined, F(Limits::quiet_NaN()));
}

/// log2 x. Exact for powers of two; +-0 gives -inf, x < 0 and NaN give NaN, +inf gives +inf.
template <Number F>
F log2(F x) {
    return with_logarithm_domain(x, log2_double_word(x).hi);
}
/// The natural logarithm, with log2's special values.
template <Number F>
F log(F x) {
    const DoubleWord<F> l = log2_double_word(x);
    return with_logarithm_domain(x, multiply(l, broadcast<F>(constants::ln_2<Scalar<F>>)).hi);
}

}  // namespace quadrel
