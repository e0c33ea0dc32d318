// The rays of a packet as one beam, and how far it stays above the surface.
//
// Coordinates and heights of a ray are linear in the number of a step. The least of linear
// functions is concave, the greatest convex: the chord of the least (greatest) at two steps is a
// lower (upper) bound of all rays at every step between. So a beam is five lines, four of which
// bound coordinates and one the heights, and the box around steps a to b is that of its two ends.
#pragma once

#include <algorithm>
#include <cmath>

#include "quadrel/relief/trace/search/height_ceiling.hpp"
#include "quadrel/relief/trace/search/lattice_rays.hpp"

namespace quadrel {

/// The least of the lanes of `among`, infinite where there are none. NaN counts as infinite.
template <Packet F>
Scalar<F> least(F x, Mask<F> among) {
    const F everywhere = select(among & (x == x), x, F(std::numeric_limits<Scalar<F>>::infinity()));
    Scalar<F> lane[lanes_of<F>];
    store(lane, everywhere);
    for (int half = lanes_of<F> / 2; half > 0; half /= 2)
        for (int i = 0; i < half; ++i)
            lane[i] = lane[i] < lane[i + half] ? lane[i] : lane[i + half];
    return lane[0];
}
template <Packet F>
Scalar<F> greatest(F x, Mask<F> among) {
    return -least(F(-x), among);
}

/// A value that changes evenly from step to step.
struct StepLine {
    double at_0 = 0, slope = 0;
    double at(double k) const { return at_0 + slope * k; }
};

inline StepLine line_through(double k0, double value0, double k1, double value1) {
    const double slope = (value1 - value0) / (k1 - k0);
    return {value0 - slope * k0, slope};
}

/// Beyond these, in tiles, float32 is too coarse for bounds to be of use.
inline constexpr float beam_limit = 65536;

struct Beam {
    StepLine u_low, u_high, v_low, v_high;  ///< in units of the texture
    StepLine height_low;                    ///< of the ray

    UvBox box(int a, int b) const {
        return {std::min(u_low.at(a), u_low.at(b)), std::max(u_high.at(a), u_high.at(b)),
                std::min(v_low.at(a), v_low.at(b)), std::max(v_high.at(a), v_high.at(b))};
    }

    /// Of steps a to b the last to which every ray is above `ceiling` from a on; a - 1 if it is not
    /// at a. The ray comes down or goes up.
    int last_above(int a, int b, double ceiling) const {
        if (!(height_low.at(a) > ceiling)) return a - 1;
        if (height_low.slope >= 0 || height_low.at(b) > ceiling) return b;
        const double k = (ceiling - height_low.at_0) / height_low.slope;
        return std::clamp(static_cast<int>(k), a, b);
    }
};

/// One coordinate of the rays at two steps.
template <Number F>
struct BeamEnds {
    F first, last;
};

/// Fills in the bounds of one coordinate; `rate` is at least by how much a ray's coordinate changes
/// along the whole relief. False where there are none.
///
/// A row's own coordinates, u + K (s - s_polygon) with s = k / n, are off by at most 2^-24 (4 |K| +
/// |u|) each, and as much is what reducing and scaling them takes from a texel's: the margin is
/// more than both together, at a sample and at the end of a line.
template <Packet F>
bool bound_coordinate(const BeamEnds<F>& ends, F rate, Mask<F> among, double k0, double k1,
                      StepLine& low, StepLine& high) {
    const auto within = [](F x) { return abs(x) <= F(beam_limit); };
    if (any(among & !(within(ends.first) & within(ends.last) & within(rate)))) return false;
    const F size = max(max(abs(ends.first), abs(ends.last)), abs(rate));
    const double margin = 0x1p-20 * (1 + static_cast<double>(greatest(size, among)));
    low = line_through(k0, least(ends.first, among) - margin, k1, least(ends.last, among) - margin);
    high = line_through(k0, greatest(ends.first, among) + margin, k1,
                        greatest(ends.last, among) + margin);
    return true;
}

}  // namespace quadrel
