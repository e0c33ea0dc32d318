// Units in the last place.
#pragma once

#include <algorithm>
#include <cmath>

namespace quadrel::test {

/// Distance from the float at or below |x| to the next.
inline double float_ulp(double x) {
    int exponent;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, std::max(exponent - 24, -149));
}

}  // namespace quadrel::test
