#include "film/draw.hpp"

#include <algorithm>
#include <sstream>

#include "film/glyphs.hpp"

namespace quadrel {
namespace {

constexpr std::uint8_t ink = 224;
static_assert(text_height == glyph_height && text_letter_width == glyph_width + 1);

/// Letters without a glyph are drawn as '?'.
const Glyph& glyph_of(char letter) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    const auto found = std::find_if(std::begin(glyphs), std::end(glyphs),
                                    [&](const Glyph& glyph) { return glyph.letter == letter; });
    return found == std::end(glyphs) ? std::end(glyphs)[-1] : *found;
}

void draw_glyph(Picture& picture, int left, int top, const Glyph& glyph) {
    for (int y = 0; y < glyph_height; ++y)
        for (int x = 0; x < glyph_width; ++x)
            if ((glyph.rows[static_cast<std::size_t>(y)] >> (glyph_width - 1 - x) & 1) != 0)
                picture.set(left + x, top + y, ink, ink, ink);
}

std::uint8_t byte(double value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
}

}  // namespace

void draw_label(Picture& picture, int left, int top, int width, const std::string& label) {
    const int right = left + width;
    for (const char letter : label) {
        if (left + glyph_width > right) return;
        draw_glyph(picture, left, top, glyph_of(letter));
        left += text_letter_width;
    }
}

void draw_picture(Picture& to, int left, int top, const Picture& from) {
    const auto row = 3 * static_cast<std::ptrdiff_t>(from.width);
    for (int y = 0; y < from.height; ++y)
        std::copy_n(from.rgb.begin() + y * row, row,
                    to.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * to.width + left));
}

std::vector<std::string> text_lines(const std::string& text, int width) {
    const auto most = static_cast<std::size_t>(std::max(1, (width + 1) / text_letter_width));
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (lines.empty() || lines.back().size() + 1 + word.size() > most)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    }
    return lines;
}

void paint_heat(Picture& picture, int x, int y, double heat) {
    picture.set(x, y, byte(2.5 * heat - 0.25), byte(2.5 * heat - 1.25),
                byte(heat < 0.4   ? 0.3 + heat
                     : heat < 0.7 ? 1.4 - 2 * heat
                                  : 3.4 * heat - 2.4));
}

}  // namespace quadrel
