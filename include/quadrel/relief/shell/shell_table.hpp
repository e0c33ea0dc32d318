// The rows of a shell as a texture of four floats a texel, for shaders, which have no arrays of
// structs: eight texels a row, rows beside each other and then one line below the other. A fragment
// has the number of its row; what is interpolated are varyings.
//
//     texel  PrismFace             ShellFace                 ShellCell
//     0      bottom of a, u of a   gradient of a, to_floor   gradient of 0, s of 0
//     1      bottom of b, u of b   gradient of b, snap       gradient of 1, s of 1
//     2      bottom of c, u of c   gradient of c, cell       gradient of 2, s of 2
//     3      top of a, v of a      gradient of u             gradient of 3, s of 3
//     4      top of b, v of b      gradient of v             uv of 0, uv of 1
//     5      top of c, v of c      gradient of s             uv of 2, uv of 3
//     6      turned, snap                                    links
//     7                                                      origin
//
// Whole numbers are floats there, and exact up to 2^24.
#pragma once

#include <array>

#include "quadrel/relief/shell/prism_face.hpp"
#include "quadrel/relief/shell/shell_cell.hpp"

namespace quadrel {

inline constexpr int shell_texels_a_row = 8;
/// A power of two, as many bits as shell_rows_bits.
inline constexpr int shell_rows_bits = 7, shell_rows_a_line = 1 << shell_rows_bits;
inline constexpr int shell_table_width = shell_texels_a_row * shell_rows_a_line;
/// Whose links, four a row, are whole numbers of floats.
inline constexpr int most_shell_rows = (1 << 22) - 2;

using ShellTexels = std::array<std::array<float, 4>, shell_texels_a_row>;

namespace detail {
inline void set_texel(std::array<float, 4>& texel, const float (&xyz)[3], float w) {
    texel = {xyz[0], xyz[1], xyz[2], w};
}
}  // namespace detail

inline ShellTexels texels_of(const PrismFace& face) {
    ShellTexels texels{};
    for (std::size_t k = 0; k < 3; ++k) {
        detail::set_texel(texels[k], face.bottom[k], face.uv[k][0]);
        detail::set_texel(texels[3 + k], face.top[k], face.uv[k][1]);
    }
    texels[6] = {face.turned, face.snap, 0, 0};
    return texels;
}

inline ShellTexels texels_of(const ShellFace& face) {
    ShellTexels texels{};
    const float others[3] = {face.to_floor, face.snap, static_cast<float>(face.cell)};
    for (std::size_t k = 0; k < 3; ++k) detail::set_texel(texels[k], face.gradient[k], others[k]);
    for (std::size_t i = 0; i < 3; ++i) {
        texels[3][i] = face.J[i];
        texels[4][i] = face.J[3 + i];
    }
    detail::set_texel(texels[5], face.s_gradient, 0);
    return texels;
}

inline ShellTexels texels_of(const ShellCell& cell) {
    ShellTexels texels{};
    for (std::size_t k = 0; k < 4; ++k) {
        detail::set_texel(texels[k], cell.gradient[k], cell.s[k]);
        for (std::size_t i = 0; i < 2; ++i) texels[4 + k / 2][2 * (k % 2) + i] = cell.uv[k][i];
        texels[6][k] = static_cast<float>(cell.link[k]);
    }
    detail::set_texel(texels[7], cell.origin, 0);
    return texels;
}

}  // namespace quadrel
