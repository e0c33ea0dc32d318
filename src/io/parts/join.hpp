// Parts of an image put together.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "quadrel/film/exr.hpp"

namespace quadrel {

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
