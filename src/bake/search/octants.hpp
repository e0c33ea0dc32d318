// Eight sectors of 45 degrees, the k-th from azimuth 45 k to 45 (k + 1), counted from +u towards +v
// in tile units.
#pragma once

#include <algorithm>

namespace quadrel {

struct Interval {
    double low, high;
    Interval operator-() const { return {-high, -low}; }
};

/// Bit `bit` if the rectangle x, y touches the wedge 0 <= y <= x: octant 0, or, with other axes in
/// the place of x and y, any.
[[gnu::always_inline]] inline unsigned octant_bit(int bit, const Interval& x, const Interval& y) {
    return static_cast<unsigned>((y.high >= 0) & (x.high >= std::max(y.low, 0.0))) << bit;
}

/// Bit k: the rectangle x, y touches octant k.
inline unsigned octants_of(const Interval& x, const Interval& y) {
    return octant_bit(0, x, y) | octant_bit(1, y, x) | octant_bit(2, y, -x) | octant_bit(3, -x, y) |
           octant_bit(4, -x, -y) | octant_bit(5, -y, -x) | octant_bit(6, -y, x) |
           octant_bit(7, x, -y);
}

}  // namespace quadrel
