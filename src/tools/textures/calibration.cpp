// Small textures in which every texel tells where it is, for looking at wrap modes and filters.
#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

// Digits 0 to 7 in 3x5 texels, three bits per row, the top row first.
constexpr int digit_rows[8][5] = {{7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7},
                                  {7, 1, 7, 1, 7}, {5, 5, 7, 1, 1}, {7, 4, 7, 1, 7},
                                  {7, 4, 7, 5, 7}, {7, 1, 2, 2, 2}};

bool digit_covers(int digit, int x, int y) {
    return x >= 0 && x < 3 && y >= 0 && y < 5 && (digit_rows[digit][y] >> (2 - x) & 1);
}

/// A hue in [0, 1) at full saturation, linear light.
glm::dvec3 hue(double h) {
    const auto ramp = [&](double shift) {
        const double x = h + shift - std::floor(h + shift);
        return saturate(std::fabs(6 * x - 3) - 1);
    };
    return {ramp(0), ramp(2.0 / 3), ramp(1.0 / 3)};
}

/// 8x8 cells of 8x8 texels: hue by column, brightness by row, row and column number in white; the
/// texels of a cell alternate in brightness; rims in white (top), red (left), black (bottom,
/// right).
glm::dvec4 calibration_texel(int x, int y) {
    const int column = x / 8, row = y / 8, cx = x % 8, cy = y % 8;
    if (y == 0) return {1, 1, 1, 1};
    if (x == 0) return {1, 0, 0, 1};
    if (y == 63) return {0, 0, 0, 1};
    if (digit_covers(row, cx - 1, cy - 2) || digit_covers(column, cx - 5, cy - 2))
        return {1, 1, 1, 1};
    const double brightness = (0.12 + 0.09 * row) * ((cx + cy) & 1 ? 1 : 0.8);
    return {mix(glm::dvec3(0.5), hue(column / 8.0), 0.85) * brightness, 1};
}

/// 45x29: a red last column and a green last row, which the box rule forgets; diagonal stripes
/// else.
glm::dvec4 odd_texel(int x, int y) {
    if (x == 44) return {1, 0.05, 0.05, 1};
    if (y == 28) return {0.05, 1, 0.05, 1};
    const bool stripe = (x + y) % 6 < 3;
    return {stripe ? srgb(0x2a4d8f) : srgb(0xe8e0c8), 1};
}

}  // namespace

void write_calibration(const std::filesystem::path& directory) {
    write_colour(directory / "calibration.exr", make_grid<glm::dvec4>(64, 64, calibration_texel));
    write_colour(directory / "calibration_45x29.exr", make_grid<glm::dvec4>(45, 29, odd_texel));
    write_data(directory / "mirror_gloss.exr",
               Grid<glm::dvec3>(4, 4, glm::dvec3(1, 1 / 1.5 / 2, 1)));
}

/// Checks of 1 texel in red, 4 in green, 16 in blue: a channel is even grey from the level on at
/// which its checks are smaller than a texel (1, 3, 5), so the colours tell the mip level.
void write_mip_levels(const std::filesystem::path& directory) {
    const auto check = [](int x, int y, int side) { return (x / side + y / side) & 1 ? 1.0 : 0.0; };
    write_data(directory / "mip_levels.exr", make_grid<glm::dvec3>(256, 256, [&](int x, int y) {
                   return glm::dvec3(check(x, y, 1), check(x, y, 4), check(x, y, 16));
               }));
}

}  // namespace quadrel::textures
