// The readers behind load_image, one a library.
#pragma once

#include <optional>

#include "file/file_bytes.hpp"
#include "texture/stored_image.hpp"

namespace quadrel {

/// A flat part of an EXR: of its channels (of the layer) R G B A as far as present without gaps,
/// else X Y Z, with A where present, else Y or Y A, else the only channel whatever its name. The
/// image is the display window; what the data window does not cover is 0. Throws InputError.
Image read_exr_image(const FileBytes& file, const ImageSelection& selection,
                     const std::string& key);

/// A bitmap packed by runs (BMP, RLE8 or RLE4), or nothing if the file is none. Throws InputError.
std::optional<Image> read_packed_bitmap(const std::string& file, const std::string& key);

/// An image within a glTF file, which `selection` names as a part. Throws InputError.
Image read_embedded_image(const FileBytes& file, const ImageSelection& selection,
                          const std::string& key);

/// Everything that OpenImageIO reads, through its module, turned as the file says that it stands.
/// Throws InputError.
StoredImage read_other_image(const std::string& file, const std::string& key);

/// Throws InputError unless an image of that size can become a texture.
void check_image_size(std::int64_t width, std::int64_t height, std::int64_t channels,
                      const std::string& file, const std::string& key);

}  // namespace quadrel
