// Textures of images whose content has a name already.
#pragma once

#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// make_texture, with `content` in place of the hash of the image's values: hashing a large image
/// takes as long as reading it.
std::shared_ptr<const Texture> make_texture(const Image& image, const TextureOptions& options,
                                            const std::string& content);
std::shared_ptr<const Texture> make_cube_texture(const std::array<Image, 6>& faces,
                                                 const TextureOptions& options,
                                                 const std::string& content);

}  // namespace quadrel
