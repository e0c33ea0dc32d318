// The exact value of a varying, in rationals: the judge of interpolation.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <optional>

#include "quadrel/raster/interpolation.hpp"
#include "raster/support.hpp"
#include "ulp.hpp"

namespace quadrel::test {

using Values = std::array<float, 3>;

/// At one lane; null where the edges' weighted sum vanishes.
struct ExactValue {
    mpq_class value;
    double kappa = 1;    ///< sum|q_i| / |s|
    double largest = 0;  ///< max|v_i|
};

/// Integers of up to 62 bits.
inline mpz_class integer(std::int64_t x) { return mpz_class(static_cast<long>(x)); }

inline std::optional<ExactValue> exact_value(const ScreenTriangle& t, const QuadEdges& edges,
                                             std::size_t lane, const Values& v) {
    mpq_class s = 0, absolute = 0, sum = 0;
    ExactValue exact;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class q =
            mpq_class(integer(edges[i][lane])) / mpq_class(static_cast<double>(t.vertex[i].w));
        s += q;
        absolute += abs(q);
        sum += q * mpq_class(static_cast<double>(v[i]));
        exact.largest = std::max(exact.largest, std::fabs(static_cast<double>(v[i])));
    }
    if (s == 0) return {};
    exact.value = sum / s;
    exact.kappa = mpq_class(absolute / abs(s)).get_d() * (1 + 1e-12);
    return exact;
}

/// What interpolation.hpp promises of a float, or of a double.
inline double allowed_error(const ExactValue& exact, float) {
    return (interpolation_ulps * float_ulp(exact.value.get_d()) +
            interpolation_unit * exact.largest) *
           exact.kappa;
}
inline double allowed_error(const ExactValue& exact, double) {
    return interpolation_unit * (std::fabs(exact.value.get_d()) + exact.largest) * exact.kappa;
}

template <class T>
double error_of(const ExactValue& exact, T got) {
    return std::fabs(mpq_class(mpq_class(static_cast<double>(got)) - exact.value).get_d());
}

}  // namespace quadrel::test
