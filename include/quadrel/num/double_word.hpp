// Double-word arithmetic: an unevaluated sum of two numbers, twice the precision of its type. Every
// float type and instruction set gives the same bits: a fused multiply-add only yields what a
// product leaves exactly. Source: Joldes, Muller and Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017; the algorithms are
// Knuth's and Dekker's.
#pragma once

#include <limits>

#include "quadrel/num/traits.hpp"

namespace quadrel {

/// hi + lo with |lo| at most half an ulp of hi, unless said otherwise.
template <Number F>
struct DoubleWord {
    F hi;
    F lo;
};

/// A constant given as two words of the scalar type.
template <class T>
struct WordPair {
    T hi;
    T lo;
};
template <Number F>
DoubleWord<F> broadcast(WordPair<Scalar<F>> constant) {
    return {F(constant.hi), F(constant.lo)};
}

/// a + b exactly (Knuth's 2Sum).
template <Number F>
DoubleWord<F> two_sum(F a, F b) {
    const F sum = a + b;
    const F b_part = sum - a;
    const F a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}
/// a + b exactly, for a = 0 or |a| >= |b| (Dekker's Fast2Sum).
template <Number F>
DoubleWord<F> fast_two_sum(F a, F b) {
    const F sum = a + b;
    return {sum, b - (sum - a)};
}
/// a in two halves of at most half the digits each (Veltkamp). Overflows near the largest numbers.
template <Number F>
DoubleWord<F> split(F a) {
    using T = Scalar<F>;
    constexpr int low_digits = (std::numeric_limits<T>::digits + 1) / 2;
    const F scaled = a * F(T((1LL << low_digits) + 1));
    const F hi = scaled - (scaled - a);
    return {hi, a - hi};
}
/// a * b exactly, unless a split overflows or the error underflows (Dekker's product).
template <Number F>
DoubleWord<F> two_product(F a, F b) {
    const F product = a * b;
    const DoubleWord<F> p = split(a);
    const DoubleWord<F> q = split(b);
    const F error = ((p.hi * q.hi - product) + p.hi * q.lo + p.lo * q.hi) + p.lo * q.lo;
    return {product, error};
}

/// A product in two words: any, and one that is 0 or so large that its error cannot underflow (at
/// least 2^-100 in float). The error of the latter is one number however it is computed: a fused
/// multiply-add gives it in one instruction, where the number type has one.
struct AnyProduct {
    template <Number F>
    DoubleWord<F> operator()(F a, F b) const {
        return two_product(a, b);
    }
};
struct OrdinaryProduct {
    template <Number F>
    DoubleWord<F> operator()(F a, F b) const {
        if constexpr (requires(F x) { PacketOps<F>::product_error(x, x, x); }) {
            const F product = a * b;
            return {product, PacketOps<F>::product_error(a, b, product)};
        } else {
            return two_product(a, b);
        }
    }
};

/// a + b, for a = 0 or |a| >= |b|.
template <Number F>
DoubleWord<F> fast_add(F a, DoubleWord<F> b) {
    const DoubleWord<F> sum = fast_two_sum(a, b.hi);
    return fast_two_sum(sum.hi, sum.lo + b.lo);
}
/// a + b, for |a| >= |b|.
template <Number F>
DoubleWord<F> fast_add(DoubleWord<F> a, F b) {
    const DoubleWord<F> sum = fast_two_sum(a.hi, b);
    return fast_two_sum(sum.hi, sum.lo + a.lo);
}
// Of all three the leading product is `Product`'s.
template <class Product = AnyProduct, Number F>
DoubleWord<F> multiply(DoubleWord<F> a, F b) {
    const DoubleWord<F> product = Product()(a.hi, b);
    return fast_two_sum(product.hi, product.lo + a.lo * b);
}
template <class Product = AnyProduct, Number F>
DoubleWord<F> multiply(DoubleWord<F> a, DoubleWord<F> b) {
    const DoubleWord<F> product = Product()(a.hi, b.hi);
    return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}
template <class Product = AnyProduct, Number F>
DoubleWord<F> divide(DoubleWord<F> a, DoubleWord<F> b) {
    const F quotient = a.hi / b.hi;
    const DoubleWord<F> product = Product()(quotient, b.hi);
    const F rest = ((a.hi - product.hi) - product.lo) + (a.lo - quotient * b.lo);
    return fast_two_sum(quotient, rest / b.hi);
}

}  // namespace quadrel
