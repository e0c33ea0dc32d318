// The oracle in rational arithmetic: heights and ray are binary fractions, so the sign of every
// quantity that decides whether and where a ray meets the bilinear field is known exactly. For rays
// on which rounding could decide; slow.
#pragma once

#include <gmpxx.h>

#include "relief/exact/oracle.hpp"

namespace quadrel::test::oracle {

/// A long double, exactly.
inline mpq_class rational(Real x) {
    int exponent;
    const Real fraction = std::frexp(x, &exponent);  // |fraction| < 1, 64 bits
    const Real high = std::trunc(std::ldexp(fraction, 32));
    const Real low = std::ldexp(std::ldexp(fraction, 32) - high, 32);
    mpq_class value(static_cast<double>(high));
    value *= mpq_class(4294967296.0);
    value += mpq_class(static_cast<double>(low));
    mpz_class power(1);
    power <<= static_cast<unsigned long>(std::abs(exponent - 64));
    return exponent > 64 ? mpq_class(value * power) : mpq_class(value / power);
}

inline long floor_of(const mpq_class& x) {
    mpz_class quotient;
    mpz_fdiv_q(quotient.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return quotient.get_si();
}

/// q of a cell about s = `from`, and whether q >= 0 anywhere in [0, length].
struct ExactQuadratic {
    mpq_class A, B, C;

    bool reaches_zero(const mpq_class& length) const {
        if (C >= 0 || (A * length + B) * length + C >= 0) return true;
        // Both ends below: only a peak between them can reach.
        if (A >= 0 || B <= 0 || B >= -2 * A * length) return false;
        return B * B - 4 * A * C >= 0;
    }
};

/// A ray in rationals.
struct ExactRay {
    mpq_class x, y, dx, dy;

    ExactRay(const Field& field, const Ray& ray)
        : x((rational(ray.u) - rational(ray.s_polygon) * rational(ray.Ku)) * field.width -
            mpq_class(1, 2)),
          y((rational(ray.v) - rational(ray.s_polygon) * rational(ray.Kv)) * field.height -
            mpq_class(1, 2)),
          dx(rational(ray.Ku) * field.width),
          dy(rational(ray.Kv) * field.height) {}

    /// First border of an axis that is met after s, or 2.
    static mpq_class next_border(const mpq_class& start, const mpq_class& rate,
                                 const mpq_class& s) {
        if (rate == 0) return 2;
        const mpq_class at = start + rate * s;
        const long below = floor_of(at);
        const long border = rate > 0 ? below + 1 : (at == below ? below - 1 : below);
        return (border - start) / rate;
    }
};

inline ExactQuadratic exact_quadratic(const Field& field, const ExactRay& ray, long i, long j,
                                      const mpq_class& s) {
    const mpq_class h00 = rational(field.texel(i, j)), h10 = rational(field.texel(i + 1, j));
    const mpq_class h01 = rational(field.texel(i, j + 1)),
                    h11 = rational(field.texel(i + 1, j + 1));
    const mpq_class b = h10 - h00, c = h01 - h00, d = h00 - h10 - h01 + h11;
    const mpq_class f = ray.x + ray.dx * s - i, g = ray.y + ray.dy * s - j;
    return {d * ray.dx * ray.dy, b * ray.dx + c * ray.dy + d * (f * ray.dy + g * ray.dx) + 1,
            h00 + b * f + c * g + d * f * g - (1 - s)};
}

/// The first hit, its cell decided exactly, its s rounded.
inline Hit meet_bilinear_exactly(const Field& field, const Ray& along) {
    const ExactRay ray(field, along);
    for (mpq_class s = 0; s < 1;) {
        const mpq_class in_x = ExactRay::next_border(ray.x, ray.dx, s);
        const mpq_class in_y = ExactRay::next_border(ray.y, ray.dy, s);
        const mpq_class to = std::min(mpq_class(1), std::min(in_x, in_y)), middle = (s + to) / 2;
        const long i = floor_of(ray.x + ray.dx * middle), j = floor_of(ray.y + ray.dy * middle);
        const ExactQuadratic q = exact_quadratic(field, ray, i, j, s);
        if (q.reaches_zero(to - s)) {
            const Real length = mpq_class(to - s).get_d();
            // That there is a root is settled: where rounding denies it, it is a peak or the end.
            Real tau = first_root(q.A.get_d(), q.B.get_d(), q.C.get_d(), length);
            const Real peak = q.A < 0 ? mpq_class(-q.B / (2 * q.A)).get_d() : length;
            if (!(tau <= length)) tau = peak > 0 ? std::min(peak, length) : length;
            return {s.get_d() + tau, true};
        }
        s = to;
    }
    return {};
}

/// meet_bilinear, and where moving all heights by 2^-56 moves the hit by more than 2^-40, the exact
/// one.
inline Hit decide_bilinear(const Field& field, const Ray& ray) {
    const Real first = meet_bilinear(field, ray, 0x1p-56L).s;
    const Real last = meet_bilinear(field, ray, -0x1p-56L).s;
    return last - first <= 0x1p-40L ? meet_bilinear(field, ray) : meet_bilinear_exactly(field, ray);
}

}  // namespace quadrel::test::oracle
