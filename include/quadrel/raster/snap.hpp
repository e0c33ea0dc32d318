// Window coordinates to the sub-pixel grid.
#pragma once

#include <cstdint>

#include "quadrel/scene/settings.hpp"

namespace quadrel {

/// Snapped coordinates are always counted in 1/256 pixel, whatever the grid's own fineness.
inline constexpr int subpixel_units = 256;

/// Snapped coordinates saturate at +-this: the guard band (clip.hpp) in 1/256 pixel.
inline constexpr std::int32_t snapped_limit = 1 << 27;

/// `value` (pixels) rounded to a grid of 2^-bits pixel, in units of 1/256 pixel. bits is in [1, 8].
/// NaN gives 0, infinities and coordinates out of range saturate. Source: D3D11.3, 3.2.4.1 and
/// 3.4.1 (8 bits, nearest even).
std::int32_t snap(double value, int bits = 8, SnapRounding rounding = SnapRounding::half_even);

}  // namespace quadrel
