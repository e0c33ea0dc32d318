// An image in files, each with some of its rows: what machines draw apart and `join` puts together.
#pragma once

#include <filesystem>
#include <functional>
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

/// Whether the file is a part of that hash, whole and readable to its last pixel.
bool is_finished_part(const std::filesystem::path& file, const std::string& hash);

/// The files of one image, which fit together.
class JoinedParts {
  public:
    /// Reads headers. Throws InputError for what is no part, for parts of images that differ in
    /// anything but their rows, and where one is missing or there twice.
    explicit JoinedParts(const std::vector<std::filesystem::path>& files);

    ExrCompression compression() const { return compression_; }
    const Film& layout() const { return layout_; }  ///< planes without values

    /// Writes the file that the render of the whole image writes, some rows at a time; `progress`
    /// is called with 0 to 1. Throws InputError where a part is damaged, OutputError.
    void write(const std::filesystem::path& output, ExrCompression compression,
               const std::function<void(double)>& progress) const;

  private:
    std::vector<std::filesystem::path> files_;  ///< from the top down
    std::vector<Window> windows_;
    Film layout_;
    Attributes attributes_;
    ExrCompression compression_ = ExrCompression::zip;
};

}  // namespace quadrel
