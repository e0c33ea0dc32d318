// What kernels see of a texture: plain pointers and sizes, owned by a Texture.
#pragma once

#include <cstdint>

#include "quadrel/texture/format.hpp"

namespace quadrel {

inline constexpr int max_mip_levels = 17;  // 65536 texels a side

/// A mip chain of decoded float32 texels. Level l starts at texels + offset[l], row-major, row 0
/// first (v grows with the row), `channels` interleaved floats per texel (1, 2 or 4).
/// Cube maps: six faces (+X -X +Y -Y +Z -Z) one after the other within each level.
struct TextureView {
    const float* texels;
    std::int32_t channels;
    std::int32_t faces;  ///< 1, or 6 for a cube map
    std::int32_t levels;
    std::int32_t width[max_mip_levels], height[max_mip_levels];
    std::int32_t offset[max_mip_levels];  ///< in floats
};

/// Number of mip levels of a full chain: floor(log2(max side)) + 1.
constexpr int full_mip_levels(int width, int height) {
    int levels = 1;
    for (int side = width > height ? width : height; side > 1; side /= 2) ++levels;
    return levels;
}

/// A texture bound with its sampler state.
struct SampledTexture {
    TextureView view;
    SamplerState sampler;
};

}  // namespace quadrel
