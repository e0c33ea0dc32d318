// The readers behind load_image, one a library.
#pragma once

#include "quadrel/texture/image.hpp"

namespace quadrel {

/// Any single-part flat EXR (of a multi-part file the first part): channels R G B A as far as
/// present without gaps, else Y or Y A, else the only channel whatever its name. The image is the
/// display window; what the data window does not cover is 0. Throws InputError.
Image read_exr_image(const std::string& file, const std::string& key);

/// Everything that OpenImageIO reads, through its module. Throws InputError.
Image read_other_image(const std::string& file, const std::string& key);

/// Throws InputError unless an image of that size can become a texture.
void check_image_size(std::int64_t width, std::int64_t height, std::int64_t channels,
                      const std::string& file, const std::string& key);

}  // namespace quadrel
