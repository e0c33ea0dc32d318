// The pixels of one part of an EXR file, row by row, so that a reader need not hold more of them
// than it asks for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "file/file_bytes.hpp"

namespace quadrel {

/// Pixels of one row that lie side by side, of one channel.
struct ExrRun {
    std::size_t channel = 0;  ///< index into the channels that were asked for
    int x = 0, y = 0;         ///< of the first pixel
    int count = 0;
    /// Bits of float32, or integers; a half comes as the float32 of the same value.
    const std::uint32_t* bits = nullptr;
};

/// Called from several threads at once, never twice for a pixel.
using ExrSink = std::function<void(const ExrRun&)>;

/// Not for several threads at once.
class ExrPixels {
  public:
    virtual ~ExrPixels() = default;
    /// Hands out all pixels of the rows y0 to y1 - 1, which must lie in the data window; pixels of
    /// other rows may come as well, where they share a chunk with these. Equal bytes of the file
    /// give equal pixels. Throws std::exception for damage that shows.
    virtual void read(int y0, int y1, const ExrSink& sink) = 0;
};

/// `channels` are full names, of one value a pixel each. The file must outlive what is opened.
/// Throws std::exception where it is damaged or deep.
std::unique_ptr<ExrPixels> open_exr_pixels(const FileBytes& file, int part,
                                           std::vector<std::string> channels);

}  // namespace quadrel
