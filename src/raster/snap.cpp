#include "quadrel/raster/snap.hpp"

#include <cmath>

namespace quadrel {
namespace {

double round_half_away(double x) {
    const double whole = std::trunc(x);
    return std::fabs(x - whole) >= 0.5 ? whole + std::copysign(1.0, x) : whole;
}

/// std::nearbyint depends on the rounding mode; adding and subtracting 2^52 does too. This doesn't.
double round_half_even(double x) {
    const double below = std::floor(x), rest = x - below;
    if (rest != 0.5) return rest < 0.5 ? below : below + 1;
    return std::fmod(below, 2.0) == 0 ? below : below + 1;
}

}  // namespace

std::int32_t snap(double value, int bits, SnapRounding rounding) {
    if (value != value) return 0;
    const int grid = 1 << bits, unit = subpixel_units / grid;
    const double scaled = value * grid, limit = snapped_limit / unit;
    if (scaled >= limit) return snapped_limit;
    if (scaled <= -limit) return -snapped_limit;
    const double rounded =
        rounding == SnapRounding::half_even ? round_half_even(scaled) : round_half_away(scaled);
    return static_cast<std::int32_t>(rounded) * unit;
}

}  // namespace quadrel
