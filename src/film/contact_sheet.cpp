#include <algorithm>

#include "film/glyphs.hpp"
#include "quadrel/check.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

constexpr int margin = 4;
constexpr std::uint8_t paper = 32, ink = 224;

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

/// Draws what fits into `width`.
void draw_label(Picture& picture, int left, int top, int width, const std::string& label) {
    const int right = left + width;
    for (const char letter : label) {
        if (left + glyph_width > right) return;
        draw_glyph(picture, left, top, glyph_of(letter));
        left += glyph_width + 1;
    }
}

void draw_picture(Picture& sheet, int left, int top, const Picture& picture) {
    const auto row = 3 * static_cast<std::ptrdiff_t>(picture.width);
    for (int y = 0; y < picture.height; ++y)
        std::copy_n(
            picture.rgb.begin() + y * row, row,
            sheet.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * sheet.width + left));
}

}  // namespace

Picture contact_sheet(std::span<const SheetEntry> entries, int columns) {
    QUADREL_CHECK(columns >= 1, columns);
    int width = 0, height = 0;
    for (const SheetEntry& entry : entries) {
        width = std::max(width, entry.picture.width);
        height = std::max(height, entry.picture.height);
    }
    const int count = static_cast<int>(entries.size());
    const int used = std::max(1, std::min(columns, count));
    const int cell_width = width + margin;
    const int cell_height = height + glyph_height + 2 * margin;
    const int rows = std::max(1, (count + used - 1) / used);
    Picture sheet(used * cell_width + margin, rows * cell_height + margin, paper);
    for (int i = 0; i < count; ++i) {
        const SheetEntry& entry = entries[static_cast<std::size_t>(i)];
        const int left = margin + i % used * cell_width;
        const int top = margin + i / used * cell_height;
        draw_picture(sheet, left, top, entry.picture);
        draw_label(sheet, left, top + height + margin, width, entry.label);
    }
    return sheet;
}

}  // namespace quadrel
