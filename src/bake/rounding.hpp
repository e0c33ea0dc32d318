// From double to what a map stores, on the safe side.
#pragma once

#include <cmath>
#include <limits>

namespace quadrel {

/// What a few roundings in double can add to a positive value, relatively, with room to spare.
inline constexpr double safe_slack = 0x1p-49;

/// The greatest float that is not above x.
inline float round_down(double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                      : f;
}

/// The least float that is not below x.
inline float round_up(double x) { return -round_down(-x); }

/// The greatest unorm code of `bits` bits whose decoded value is not above x, decoded; x in [0, 1].
inline float floor_to_code(float x, int bits) {
    const float top = static_cast<float>((1 << bits) - 1);
    float code = std::floor(x * top);
    while (code > 0 && code / top > x) --code;
    while (code < top && (code + 1) / top <= x) ++code;
    return code / top;
}

}  // namespace quadrel
