// Pictures to look at: 8-bit sRGB, never a ground truth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// 8-bit sRGB pixels, interleaved R G B, row-major from the top-left.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    Picture() = default;
    /// Every component `gray`.
    Picture(int width, int height, std::uint8_t gray);
    void set(int x, int y, std::uint8_t r, std::uint8_t g, std::uint8_t b);
};

/// The sRGB code (IEC 61966-2-1) nearest to a linear value; below 0 gives 0, above 1 gives 255, NaN
/// gives 0. Exact to the rounding of the 255 thresholds in double; the same on every machine.
std::uint8_t srgb_code(float linear);

/// The film's window as people see it: R, G and B, encoded as sRGB; pixels with a NaN are magenta.
/// A film without these three shows the group of its first channel, as far as that has 2 or 3
/// components of one ending (X Y Z, U V, R G B, 0 1 2), in red, green and blue, without sRGB but
/// for light: unit vectors (N, Ng) from -1 to 1, bary from 0 to 1, texture coordinates (uv, hit)
/// their fraction, others each component from its least to its greatest finite value; pixels whose
/// components are all 0, as where nothing covers, are black. Any other channel is shown in gray,
/// its finite values spread from 0 to 255. The film must have a channel.
Picture preview(const Film& film);

/// The channels that preview shows: R G B, one group's, or one.
std::vector<std::string> preview_channels(const Film& film);

/// One picture of a contact sheet.
struct SheetEntry {
    std::string label;  ///< ASCII; small letters are drawn as capitals
    Picture picture;
};

/// The pictures in rows of `columns` (>= 1), each in a cell of the largest size, label below.
Picture contact_sheet(std::span<const SheetEntry> entries, int columns);

/// Writes a PNG whole or not at all. Throws OutputError.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace quadrel
