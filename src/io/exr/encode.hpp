// Films to the bytes of EXR files, by OpenEXR's C library: its chunks are made one at a time, so
// that all threads compress while one writes.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "film/band_sink.hpp"
#include "io/exr/write_context.hpp"

namespace quadrel {

/// Encodes a file of one part or more. NaNs become canonical_nan. The bytes do not depend on
/// threads. Throws what `output` throws, std::bad_alloc, and std::runtime_error with the library's
/// text.
void encode_exr(std::span<const ExrPartView> parts, const ExrWriting& writing,
                const ExrOutput& output);

/// An output that is kept in memory.
ExrOutput append_to(std::string& bytes);

/// A file of one part, of bands: the bytes that encode_exr gives for the film that they are of. The
/// headers are written at once, chunks as soon as the bands that they lie in are there. `layout`
/// and `attributes` are needed by this call alone. It, and the sink, throw as encode_exr does.
std::unique_ptr<BandSink> exr_band_sink(const Film& layout, const Attributes& attributes,
                                        ExrCompression compression, ExrOutput output);

}  // namespace quadrel
