// Eight sectors of 45 degrees, the k-th from azimuth 45 k to 45 (k + 1), counted from +u towards +v
// in tile units.
#pragma once

#include "bake/block_search.hpp"

namespace quadrel {

struct Interval {
    double low, high;
    Interval operator-() const { return {-high, -low}; }
};

/// Whether the rectangle x, y touches the wedge 0 <= y <= x.
inline bool touches_first_octant(const Interval& x, const Interval& y) {
    return y.high >= 0 && x.high >= std::max(y.low, 0.0);
}

/// Whether it touches octant k: the first octant of mirrored axes.
inline bool touches_octant(int k, const Interval& x, const Interval& y) {
    switch (k) {
        case 0:
            return touches_first_octant(x, y);
        case 1:
            return touches_first_octant(y, x);
        case 2:
            return touches_first_octant(y, -x);
        case 3:
            return touches_first_octant(-x, y);
        case 4:
            return touches_first_octant(-x, -y);
        case 5:
            return touches_first_octant(-y, -x);
        case 6:
            return touches_first_octant(-y, x);
        default:
            return touches_first_octant(x, -y);
    }
}

/// Bit k: a texel of the block touches sector k, if texels are squares that reach `half` texels
/// from their centres.
inline unsigned octants_of(const Offsets& at, double half, int width, int height) {
    const Interval x{(at.u_low - half) / width, (at.u_high + half) / width};
    const Interval y{(at.v_low - half) / height, (at.v_high + half) / height};
    unsigned sectors = 0;
    for (int k = 0; k < 8; ++k) sectors |= touches_octant(k, x, y) ? 1u << k : 0u;
    return sectors;
}

}  // namespace quadrel
