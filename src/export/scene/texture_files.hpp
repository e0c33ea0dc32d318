// Textures as a GPU takes them: the bytes of each level, and what to call their format.
#pragma once

#include <string>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// What texels look like in a file of bytes.
struct TexelLayout {
    TexelFormat format;
    int channels;       ///< 1, 2 or 4
    float lacking = 0;  ///< what stands in the first three channels of those that a texture lacks
    /// As OpenGL (without GL_), DXGI and WebGPU call it.
    std::string internal_format, components, component_type, dxgi, webgpu;
};

/// How a texture is handed over: in its own format, but for what a language's interface cannot
/// filter (16-bit codes in OpenGL ES and WebGPU: as floats) or has in four channels alone (sRGB).
TexelLayout texel_layout(const Texture& texture, const std::string& language);

/// The same of depth layers: four channels, since those that a map lacks are 1, the bottom, where a
/// GPU would give 0.
TexelLayout depth_layers_layout(const Texture& texture, const std::string& language);

/// Whether each level has half the size of the one before, rounded down, as GPUs want them.
bool has_mip_sizes(const TextureView& view);

/// The sizes of a level as it is handed over. Pyramids round up: where that gives no mip sizes,
/// each level lies in the corner of one of a power of two, and the rest of it is 0.
struct LevelSide {
    int width, height;
};
LevelSide side_of_level(const TextureView& view, int level);

/// What is known of a texture's first levels.
TextureView first_levels(const TextureView& view, int levels);

/// All faces or layers of a level, of `side` each, one after the other, rows without gaps, row 0
/// first. Decoded they are the texture's values to the bit.
std::string level_bytes(const Texture& texture, int level, const TexelLayout& layout,
                        const LevelSide& side);
/// The same of a texture that is handed over with all of its levels.
std::string level_bytes(const Texture& texture, int level, const TexelLayout& layout);

}  // namespace quadrel
