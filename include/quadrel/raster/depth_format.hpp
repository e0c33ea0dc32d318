// Depth buffer formats: codes and the smallest steps, for comparison with buffers of GPUs.
// Quadrel's own depth test is on float32.
#pragma once

#include <cstdint>

namespace quadrel {

enum class DepthFormat : std::int32_t { unorm16, unorm24, float32 };

/// Largest code of a unorm format: 2^16 - 1 or 2^24 - 1.
std::uint32_t max_depth_code(DepthFormat format);

/// The code that stores `depth` (clamped to [0, 1], NaN gives 0): for unorm formats
/// floor(depth * max + 0.5), exact before rounding (D3D11.3, 17.10); for float32 the bits.
std::uint32_t depth_code(DepthFormat format, float depth);

/// Polygon offset's unit r, "minimum resolvable difference": 2^-16 or 2^-24 for unorm formats; for
/// float32 2^(e - 23), e the exponent of the largest depth of the primitive, > 0. Source: Vulkan,
/// "Depth Bias" (the exact representation).
double depth_bias_unit(DepthFormat format, float largest_depth);

}  // namespace quadrel
