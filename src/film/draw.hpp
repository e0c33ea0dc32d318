// Pictures and text on pictures.
#pragma once

#include <string>

#include "quadrel/film/preview.hpp"

namespace quadrel {

inline constexpr std::uint8_t paper = 32;    ///< gray of empty ground
inline constexpr int text_height = 7;        ///< of a letter
inline constexpr int text_line_height = 11;  ///< with space
inline constexpr int text_letter_width = 6;  ///< with space

/// Draws what fits into `width`. Small letters are drawn as capitals, unknown ones as '?'.
void draw_label(Picture& picture, int left, int top, int width, const std::string& label);

/// Copies `from` to (left, top), where it must fit.
void draw_picture(Picture& to, int left, int top, const Picture& from);

/// `text` in lines of at most `width` pixels, broken at blanks; a word that is longer has a line of
/// its own.
std::vector<std::string> text_lines(const std::string& text, int width);

/// `heat` from 0, dark blue, over red to 1, white.
void paint_heat(Picture& picture, int x, int y, double heat);

}  // namespace quadrel
