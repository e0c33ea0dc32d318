// PNG files of given 8-bit codes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace quadrel {

/// Writes codes as they are, 3 (R G B) or 4 (and alpha, unassociated) a pixel, whole or not at all.
/// Throws OutputError.
void write_png_codes(const std::filesystem::path& file, int width, int height, int channels,
                     const std::vector<std::uint8_t>& codes);

}  // namespace quadrel
