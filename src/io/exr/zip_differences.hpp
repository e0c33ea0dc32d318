// What OpenEXR's ZIP and ZIPS do to a chunk before they deflate it.
#pragma once

#include <cstdint>
#include <span>

namespace quadrel {

/// Even bytes, then odd ones, so that bytes of one place in a float lie together; each but the
/// first as its difference to the one before, plus 128 (OpenEXR 3.1, ImfZip.cpp). `out` is as long.
void zip_differences(std::span<const std::uint8_t> bytes, std::uint8_t* out);

}  // namespace quadrel
