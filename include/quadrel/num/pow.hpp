// pow. Largest error measured: see math.hpp.
#pragma once

#include "quadrel/num/log.hpp"

namespace quadrel {

/// x^y = 2^(y log2 x), the logarithm and the product in double words. In this order:
///   y = 0 or x = 1     1, also for NaN; so pow(0, 0) = 1
///   x or y NaN         NaN
///   x < 0              NaN, whatever y is (GLSL leaves it undefined)
///   x = +0 or -0       0 for y > 0, +inf for y < 0
///   x = +inf           +inf for y > 0, 0 for y < 0
///   y = +-inf          the limit, 0 or +inf
template <Number F>
F pow(F x, F y) {
    using T = Scalar<F>;
    using Limits = std::numeric_limits<T>;
    const F infinity = F(Limits::infinity());
    // |log2 x| is at least 2^-digits unless x = 1: beyond this y the result is 0 or infinite.
    const F y_limit = F(static_cast<T>(1LL << (Limits::digits / 2 + 8)) * T(1LL << Limits::digits));
    const DoubleWord<F> product = multiply(log2_double_word(x), clamp(y, -y_limit, y_limit));
    const F limit = F(constants::exp2_limit<T>);
    const F low = select(abs(product.hi) < limit, product.lo, F(0));
    const F regular = exp2(DoubleWord<F>{clamp(product.hi, -limit, limit), low});

    const F at_zero = select(y > F(0), F(0), infinity);
    const F at_infinity = select(y > F(0), infinity, F(0));
    const F positive = select(x == F(0), at_zero, select(x == infinity, at_infinity, regular));
    const F defined = select((x >= F(0)) & (y == y), positive, F(Limits::quiet_NaN()));
    return select((y == F(0)) | (x == F(1)), F(1), defined);
}
template <class A, class B>
requires MixedNumbers<A, B>
auto pow(A x, B y) {
    using F = PacketAmong<A, B>;
    return pow(widen<F>(x), widen<F>(y));
}
template <int size, Number F>
vec<size, F> pow(const vec<size, F>& x, const vec<size, F>& y) {
    return map_components([](F a, F b) { return pow(a, b); }, x, y);
}

}  // namespace quadrel
