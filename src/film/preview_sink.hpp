// A preview of an image that comes in bands.
#pragma once

#include <filesystem>
#include <memory>

#include "film/band_sink.hpp"

namespace quadrel {

/// Writes the PNG of the preview of the film that the bands are of, at its end. Keeps 3 bytes a
/// pixel, and the channels that are shown where these are spread from their least to their greatest
/// value. Throws OutputError.
std::unique_ptr<BandSink> png_file_sink(const std::filesystem::path& file, const Film& layout);

}  // namespace quadrel
