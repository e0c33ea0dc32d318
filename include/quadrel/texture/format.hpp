// The formats that a texture may have on a GPU; see decision in texture.hpp: levels are rounded to
// the format, so that a port uploads the very bytes.
#pragma once

#include <cstdint>

namespace quadrel {

/// How a texel is stored. srgb8: colour channels sRGB-encoded in 8 bits, alpha linear unorm8.
enum class TexelFormat : std::int32_t { unorm8, srgb8, unorm16, half, float32 };

/// How a mip level is made from the unrounded previous one. Sizes are max(1, floor(n / 2)).
enum class MipRule : std::int32_t {
    none,  ///< level 0 only
    box,   ///< mean of the 2x2 texels that start at twice the index (clamped to the last texel)
    area,  ///< exact area of the destination texel, for sizes that are not a power of two
};

enum class Wrap : std::int32_t {
    repeat,
    mirrored_repeat,
    clamp_to_edge,
    clamp_to_border,
    mirror_once
};
enum class Filter : std::int32_t { nearest, linear };
enum class MipFilter : std::int32_t { none, nearest, linear };

/// The formula for rho, the texel-space scale factor of a footprint.
enum class LodForm : std::int32_t {
    sqrt_max,      ///< max of the two gradient lengths, exact log2 (the reference)
    ellipse,       ///< major axis of the footprint's ellipse (D3D's ideal)
    linear_log2,   ///< exact rho^2, linear mantissa for log2 (llvmpipe)
    quartic_log2,  ///< rho^4's bits read as an integer (SwiftShader)
};

/// The level that nearest filtering of levels takes half-way between two: the finer one (OpenGL;
/// Vulkan's preference), or the even one (Vulkan permits either).
enum class LevelRounding : std::int32_t { finer, even };

/// How a texture is sampled. Plain data; passed to kernels as is.
struct SamplerState {
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    Filter mag = Filter::linear, min = Filter::linear;
    MipFilter mip = MipFilter::linear;
    float border[4] = {0, 0, 0, 0};  ///< colour outside with clamp_to_border, linear space
    float lod_bias = 0;
    float lod_min = -1000, lod_max = 1000;
    LodForm lod_form = LodForm::sqrt_max;
    std::int32_t weight_bits = 0;  ///< fraction bits of texel weights, rounded to even; 0: exact
    std::int32_t lod_bits = 0;     ///< fraction bits of the level of detail; 0: exact
    std::int32_t scale_first = 0;  ///< 1: repeat and mirror do not reduce the coordinate first
    /// 1: look-ups with implicit derivatives take lane 0's level of detail in all lanes of a quad.
    std::int32_t quad_lod = 0;
    LevelRounding level_rounding = LevelRounding::finer;  ///< with MipFilter::nearest
};

}  // namespace quadrel
