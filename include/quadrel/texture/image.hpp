// An image file as values, before it becomes a texture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "quadrel/texture/format.hpp"
#include "quadrel/texture/selection.hpp"

namespace quadrel {

/// Pixels as the file stores them, decoded exactly (unorm c / (2^bits - 1) by division, no colour
/// conversion, alpha unassociated). Row 0 is the top of the picture as it is to be seen: by the
/// resolution line of Radiance files, and by the orientation of TIFF and Exif.
struct Image {
    int width = 0, height = 0;
    int channels = 0;  ///< 1 to 4, in the order R G B A (or Y, Y A, or X Y Z)
    TexelFormat format = TexelFormat::float32;  ///< native storage; never srgb8
    std::vector<float> values;                  ///< width * height * channels, interleaved
    bool luminance = false;                     ///< channel 0 is Y, which stands for R, G and B
    std::uint64_t not_finite = 0;               ///< how many values are NaN or infinite
    std::filesystem::path file;  ///< for messages; empty for images that were computed
};

/// Largest side in texels, and most floats (all levels and faces) of a texture.
inline constexpr int max_image_side = 65536;
inline constexpr std::int64_t max_texture_floats = std::int64_t(1) << 29;

/// What load_image does about texels that are NaN or infinite.
enum class NotFinite : std::int32_t {
    refuse,  ///< InputError with the first such texel
    count,   ///< keep them; Image::not_finite counts them
};

/// Reads an image. EXR through OpenEXR; every other format through a module that wraps OpenImageIO
/// and is loaded when the first such image is met.
/// Throws InputError for anything missing, truncated, absurd in size or not an image, for one of
/// several images where `selection` does not tell which, and for a selection in a format other than
/// EXR; `key` is where a scene names the file, for the message.
Image load_image(const std::filesystem::path& file, NotFinite not_finite = NotFinite::refuse,
                 const std::string& key = "", const ImageSelection& selection = {});

}  // namespace quadrel
