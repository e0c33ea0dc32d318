// An EXR file that is written as its image is drawn.
#pragma once

#include <filesystem>
#include <memory>

#include "film/band_sink.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {

/// Writes the file that write_exr writes for the film that the bands are of; end() makes it appear,
/// or hands it to the group of outputs that there is. Throws OutputError, as does the sink, as soon
/// as something cannot be written. `layout` and `attributes` are needed by this call alone.
std::unique_ptr<BandSink> exr_file_sink(const std::filesystem::path& file, const Film& layout,
                                        const Attributes& attributes, ExrCompression compression);

}  // namespace quadrel
