// Multisample resolve.
#pragma once

#include <array>
#include <span>

namespace quadrel {

/// One sample of a pixel: colour, coverage in a, and eye-space distance (+inf where uncovered).
struct ColorSample {
    float r = 0, g = 0, b = 0, a = 0, z = 0;
};

/// The pixel's value: r g b a are the means over all samples, added in the order of their index and
/// then multiplied by 1/n (n is a power of two, so this is exact and any order of equal samples
/// gives their value); z is the nearest, that is the smallest, NaN samples not counted unless all
/// are NaN. `samples` holds 1, 2, 4, 8 or 16.
ColorSample resolve(std::span<const ColorSample> samples);

}  // namespace quadrel
