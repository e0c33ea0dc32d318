// Sine and cosine of an angle in degrees.
#pragma once

#include <cmath>

#include "quadrel/num/math.hpp"

namespace quadrel {

struct SinCos {
    double sine, cosine;
};

/// Reduced to [-45, 45] in degrees, where the reduction is exact: multiples of 90 give 0, 1, -1.
inline SinCos sin_cos_degrees(double degrees) {
    constexpr double radians_per_degree = 0.017453292519943295;
    const double whole = std::fmod(degrees, 360.0);
    const double quarter = std::floor(whole / 90.0 + 0.5);
    const double angle = (whole - 90.0 * quarter) * radians_per_degree;
    const double s = quadrel::sin(angle), c = quadrel::cos(angle);
    switch (static_cast<int>(quarter) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace quadrel
