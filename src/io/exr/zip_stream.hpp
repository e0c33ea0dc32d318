// What OpenEXR calls ZIP: bytes apart by significance, each as the difference to the one before, in
// a zlib stream. By libdeflate, which takes half of zlib's time on films, at the same size, and
// less than half to read maps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;

namespace quadrel {

/// One thread's: its tables serve one stream after the other.
class ZipStream {
  public:
    /// Throws std::bad_alloc.
    ZipStream();

    /// The stream, until the next call; empty where it would not be shorter than the bytes.
    std::span<const std::uint8_t> compress(std::span<const std::uint8_t> bytes);

  private:
    struct Free {
        void operator()(libdeflate_compressor* compressor) const;
    };
    std::unique_ptr<libdeflate_compressor, Free> compressor_;
    std::vector<std::uint8_t> differences_, stream_;
};

/// Fills `bytes` with what the stream was made of; false where it is damaged or of another length.
/// Throws std::bad_alloc.
bool unzip(std::span<const std::uint8_t> stream, std::span<std::uint8_t> bytes);

}  // namespace quadrel
