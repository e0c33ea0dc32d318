// The standard sample positions within a pixel.
#pragma once

#include <cstdint>
#include <span>

namespace quadrel {

/// Offset from the pixel's corner of smallest window x and y, in 1/16 pixel, each in [0, 15].
struct SamplePosition {
    std::int32_t x = 8, y = 8;
    bool operator==(const SamplePosition&) const = default;
};

/// True for 1, 2, 4, 8 and 16.
bool is_sample_count(int samples);

/// The positions of the samples of a pixel, in index order; `samples` is 1, 2, 4, 8 or 16.
/// Source: Vulkan, "Standard sample locations"; D3D11.3, 19.2.4.
std::span<const SamplePosition> sample_positions(int samples);

}  // namespace quadrel
