#include <algorithm>

#include "film/draw.hpp"
#include "quadrel/check.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

constexpr int margin = 4;

/// That a label may ask for; what is longer takes several lines.
constexpr int widest_label = 16 * text_letter_width;

/// The label in lines: broken at blanks, and where a word is too long.
std::vector<std::string> label_lines(const std::string& label, int width) {
    const auto most = static_cast<std::size_t>(width / text_letter_width);
    std::vector<std::string> lines;
    for (std::string line : text_lines(label, width)) {
        for (; line.size() > most; line.erase(0, most)) lines.push_back(line.substr(0, most));
        lines.push_back(line);
    }
    return lines;
}

}  // namespace

Picture contact_sheet(std::span<const SheetEntry> entries, int columns) {
    QUADREL_CHECK(columns >= 1, columns);
    int width = text_letter_width, height = 0, lines = 1;
    for (const SheetEntry& entry : entries) {
        const int label = text_letter_width * static_cast<int>(entry.label.size());
        width = std::max({width, entry.picture.width, std::min(widest_label, label)});
        height = std::max(height, entry.picture.height);
    }
    for (const SheetEntry& entry : entries)
        lines = std::max(lines, static_cast<int>(label_lines(entry.label, width).size()));
    const int count = static_cast<int>(entries.size());
    const int used = std::max(1, std::min(columns, count));
    const int cell_width = width + margin;
    const int cell_height = height + text_height + (lines - 1) * text_line_height + 2 * margin;
    const int rows = std::max(1, (count + used - 1) / used);
    Picture sheet(used * cell_width + margin, rows * cell_height + margin, paper);
    for (int i = 0; i < count; ++i) {
        const SheetEntry& entry = entries[static_cast<std::size_t>(i)];
        const int left = margin + i % used * cell_width;
        const int top = margin + i / used * cell_height;
        draw_picture(sheet, left, top, entry.picture);
        int line_top = top + height + margin;
        for (const std::string& line : label_lines(entry.label, width)) {
            draw_label(sheet, left, line_top, width, line);
            line_top += text_line_height;
        }
    }
    return sheet;
}

}  // namespace quadrel
