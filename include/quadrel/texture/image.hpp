// An image file as values, before it becomes a texture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "quadrel/texture/format.hpp"

namespace quadrel {

/// Pixels as the file stores them, decoded exactly (unorm c / (2^bits - 1) by division, no colour
/// conversion, alpha unassociated). Row 0 is the first stored row (the top, in every format read).
struct Image {
    int width = 0, height = 0;
    int channels = 0;                           ///< 1 to 4, in the order R G B A (or Y, Y A)
    TexelFormat format = TexelFormat::float32;  ///< native storage; never srgb8
    std::vector<float> values;                  ///< width * height * channels, interleaved
};

/// Reads an image. EXR through OpenEXR; every other format through a module that wraps OpenImageIO
/// and is loaded when the first such image is met.
/// Throws InputError for anything missing, truncated, absurd in size or not an image.
Image load_image(const std::filesystem::path& file);

}  // namespace quadrel
