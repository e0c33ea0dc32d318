#include <algorithm>

#include "film/draw.hpp"
#include "quadrel/check.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

constexpr int margin = 4;

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
    const int cell_height = height + text_height + 2 * margin;
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
