// exp2 and exp. Largest error measured (tests/num/ulp_exhaustive.cpp): see math.hpp.
#pragma once

#include "quadrel/num/double_word.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/polynomial.hpp"

namespace quadrel {

namespace constants {
template <class T>
inline constexpr WordPair<T> ln_2{};
template <>
inline constexpr WordPair<float> ln_2<float>{0x1.62e43p-1f, -0x1.05c61p-29f};
template <>
inline constexpr WordPair<double> ln_2<double>{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

template <class T>
inline constexpr WordPair<T> log2_e{};
template <>
inline constexpr WordPair<float> log2_e<float>{0x1.715476p+0f, 0x1.4ae0cp-26f};
template <>
inline constexpr WordPair<double> log2_e<double>{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};

/// (2^r - 1 - r ln 2) / r^2 on |r| <= 0.501, by interpolation at the Chebyshev nodes.
template <class T>
inline constexpr std::array<T, 1> exp2_tail{};
template <>
inline constexpr std::array<float, 6> exp2_tail<float>{0x1.ebfbep-3f,   0x1.c6b08ep-5f,
                                                       0x1.3b2a52p-7f,  0x1.5d87cp-10f,
                                                       0x1.44149ap-13f, 0x1.008ac8p-16f};
template <>
inline constexpr std::array<double, 11> exp2_tail<double>{
    0x1.ebfbdff82c58fp-3,  0x1.c6b08d704a0c2p-5,  0x1.3b2ab6fba4e78p-7,  0x1.5d87fe78a522p-10,
    0x1.430912f86bf3p-13,  0x1.ffcbfc673a9fdp-17, 0x1.62c022402d57ap-20, 0x1.b524fa5dd26a3p-24,
    0x1.e4cf1c64949f7p-28, 0x1.e9d50e594c8e7p-32, 0x1.c4904e1e94586p-36};

/// 2^x overflows above this, and underflows to 0 below its negative.
template <class T>
inline constexpr T exp2_limit =
    std::numeric_limits<T>::max_exponent + std::numeric_limits<T>::digits + 8;
}  // namespace constants

/// 2^x of a double word with |x| at most constants::exp2_limit.
template <Number F>
F exp2(DoubleWord<F> x) {
    using T = Scalar<F>;
    const F n = round_even(x.hi);
    const DoubleWord<F> r = two_sum(x.hi - n, x.lo);
    // 2^r = 1 + r ln 2 + r^2 q(r); what is added to 1 last is kept in two words.
    const DoubleWord<F> linear = two_product(r.hi, F(constants::ln_2<T>.hi));
    const F tail = r.hi * r.hi * polynomial(r.hi, constants::exp2_tail<T>) +
                   (linear.lo + r.hi * F(constants::ln_2<T>.lo));
    const DoubleWord<F> sum = fast_two_sum(F(1), linear.hi);
    const F low = r.lo * F(constants::ln_2<T>.hi) * sum.hi;
    const F power = sum.hi + (sum.lo + (tail + low));
    // In two steps: 2^n alone may overflow or be denormal where the result is not.
    const F half = floor(n * F(T(0.5)));
    return power * power_of_two(half) * power_of_two(n - half);
}

/// 2^x. Exact for integers. +inf gives +inf, -inf gives 0, NaN gives NaN; denormal results are
/// rounded twice (error below 1 ulp).
template <Number F>
F exp2(F x) {
    const F limit = F(constants::exp2_limit<Scalar<F>>);
    return exp2(DoubleWord<F>{clamp(x, -limit, limit), F(0)});
}

/// e^x, with exp2's special values.
template <Number F>
F exp(F x) {
    using T = Scalar<F>;
    // |x log2 e| stays below exp2's limit; e^x has left the type's range well before.
    const F limit = F(constants::exp2_limit<T> * T(0.6875));
    return exp2(multiply(broadcast<F>(constants::log2_e<T>), clamp(x, -limit, limit)));
}

}  // namespace quadrel
