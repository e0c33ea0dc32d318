// A file with some rows of an image: which ones, and of what image.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/film/exr.hpp"

namespace quadrel {

/// Which part of an image; a file says it in its attributes.
struct ImagePart {
    int number = 1, of = 1;  ///< counted from 1
    Window whole;            ///< of the image that the parts make
};

/// Parts are cut between rows of 64 pixels from the top, which chunks of every compression divide.
inline constexpr int part_rows = 64;

/// The rows of a part. Throws UsageError where the image has fewer rows of tiles than parts.
Window part_window(const ImagePart& part);

/// What tells one part of a render from every other: a hash of all that its values depend on.
/// `attributes` are those of the render, `channels` what is asked for.
std::string part_hash(const ImagePart& part, const Window& frame, const Attributes& attributes,
                      const std::vector<std::string>& channels, ExrCompression compression);

/// Says in the attributes of a file which part it is.
void name_part(const ImagePart& part, const std::string& hash, Attributes& attributes);

/// The part that a file says it is; nothing where it says none.
std::optional<ImagePart> part_of(const Attributes& attributes);

/// Without what name_part has added.
Attributes without_part(Attributes attributes);

/// Whether the file is a part of that hash, whole and readable to its last pixel.
bool is_finished_part(const std::filesystem::path& file, const std::string& hash);

}  // namespace quadrel
