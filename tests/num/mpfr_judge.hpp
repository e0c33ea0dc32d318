// The error of a computed value in units in the last place, judged by MPFR. One ulp is the spacing
// of the type at the exact value (that of the denormals below the normal range).
#pragma once

#include <mpfr.h>

#include <cmath>
#include <limits>

namespace quadrel::num_tests {

/// A number of 200 bits: far more than any double function's result needs.
class Exact {
  public:
    explicit Exact(double value = 0) {
        mpfr_init2(value_, 200);
        mpfr_set_d(value_, value, MPFR_RNDN);
    }
    ~Exact() { mpfr_clear(value_); }
    Exact(const Exact&) = delete;
    Exact& operator=(const Exact&) = delete;
    mpfr_ptr get() { return value_; }

  private:
    mpfr_t value_;
};

/// An MPFR function of one argument, such as mpfr_sin.
using ExactFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using ExactFunction2 = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// |found - exact| / ulp. Both NaN, or both overflowed alike, count as 0; only one NaN as infinity.
template <class T>
double ulp_error(T found, Exact& exact) {
    using Limits = std::numeric_limits<T>;
    const T rounded = sizeof(T) == 4 ? static_cast<T>(mpfr_get_flt(exact.get(), MPFR_RNDN))
                                     : static_cast<T>(mpfr_get_d(exact.get(), MPFR_RNDN));
    if (found == rounded && std::isinf(rounded)) return 0;
    if (found != found || rounded != rounded) {
        return found != found && rounded != rounded ? 0 : std::numeric_limits<double>::infinity();
    }
    const bool normal = mpfr_zero_p(exact.get()) == 0;
    const long exponent = normal ? mpfr_get_exp(exact.get()) : Limits::min_exponent;
    const long lowest = std::max<long>(exponent, Limits::min_exponent) - Limits::digits;
    Exact difference(static_cast<double>(found));
    mpfr_sub(difference.get(), difference.get(), exact.get(), MPFR_RNDN);
    mpfr_mul_2si(difference.get(), difference.get(), -lowest, MPFR_RNDN);
    return std::fabs(mpfr_get_d(difference.get(), MPFR_RNDN));
}

template <class T>
double ulp_error(T found, ExactFunction f, T x) {
    Exact value(static_cast<double>(x));
    f(value.get(), value.get(), MPFR_RNDN);
    return ulp_error(found, value);
}
template <class T>
double ulp_error(T found, ExactFunction2 f, T x, T y) {
    Exact first(static_cast<double>(x));
    Exact second(static_cast<double>(y));
    f(first.get(), first.get(), second.get(), MPFR_RNDN);
    return ulp_error(found, first);
}

}  // namespace quadrel::num_tests
