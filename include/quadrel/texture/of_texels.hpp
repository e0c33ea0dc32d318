// A texture over texels that the caller holds. sampler.hpp begins with an example.
#pragma once

#include <span>
#include <stdexcept>

#include "quadrel/texture/view.hpp"

namespace quadrel {

/// A texture of one level. `texels`: row by row, row 0 (v = 0) first, 1, 2 or 4 floats per texel in
/// the order r g b a, width * height of them; they must outlive the texture and are sampled as they
/// are (linear, unrounded). Sides in [1, 65536]. Throws std::invalid_argument for another size.
inline SampledTexture texture_of_texels(std::span<const float> texels, int width, int height,
                                        const SamplerState& sampler = {}) {
    constexpr int most = 65536;
    if (width < 1 || height < 1 || width > most || height > most)
        throw std::invalid_argument("texture_of_texels: sides of 1 to 65536 texels");
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::size_t channels = texels.size() / count;
    if (texels.size() % count != 0 || (channels != 1 && channels != 2 && channels != 4))
        throw std::invalid_argument("texture_of_texels: 1, 2 or 4 floats for each texel");
    SampledTexture texture{};
    texture.view.texels = texels.data();
    texture.view.channels = static_cast<std::int32_t>(channels);
    texture.view.faces = 1;
    texture.view.levels = 1;
    texture.view.width[0] = width;
    texture.view.height[0] = height;
    texture.sampler = sampler;
    return texture;
}

}  // namespace quadrel
