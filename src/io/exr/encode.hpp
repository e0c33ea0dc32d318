// Films to the bytes of EXR files, by OpenEXR's C library: its chunks are made one at a time, so
// that all threads compress while one writes.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "quadrel/film/exr.hpp"

namespace quadrel {

/// One part of a file. What it points to must outlive the writing.
struct ExrPartView {
    const char* name = nullptr;  ///< null for the only part of a file
    const Film* film = nullptr;
    const Attributes* attributes = nullptr;
};

/// Takes bytes for a position in the file, later ones for an earlier position included. Called by
/// one thread at a time. May throw.
using ExrOutput = std::function<void(std::uint64_t position, const void* bytes, std::size_t size)>;

/// Encodes a file of one part or more. NaNs become canonical_nan. The bytes do not depend on
/// threads. Throws what `output` throws, std::bad_alloc, and std::runtime_error with the library's
/// text.
void encode_exr(std::span<const ExrPartView> parts, const ExrWriting& writing,
                const ExrOutput& output);

}  // namespace quadrel
