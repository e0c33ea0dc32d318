// Images of files that are open.
#pragma once

#include "file/file_bytes.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel {

/// As load_image of a path. What is no EXR is opened again, by its name.
Image load_image(const FileBytes& file, NotFinite not_finite, const std::string& key,
                 const ImageSelection& selection);

}  // namespace quadrel
