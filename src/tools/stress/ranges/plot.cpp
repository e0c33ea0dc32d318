// The ranges as an SVG picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quadrel/num/math.hpp"
#include "stress/ranges/ranges.hpp"

namespace quadrel::stress {
namespace {

constexpr int panel_width = 250, panel_height = 190, left = 46, top = 44, gap_x = 54, gap_y = 74;
constexpr int legend_width = 190;
/// Decimal exponents of texels at the bottom and at the top.
constexpr double lowest = -8, highest = 4;
/// Rows that get a colour; the others of a table with more are gray.
constexpr std::size_t most_coloured = 10;
constexpr const char* colours[most_coloured] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#8c564b", "#000000",
                                                "#7f3fbf", "#6b8e23"};

double log10_of(double x) { return quadrel::log2(x) / quadrel::log2(10.0); }

struct Panel {
    int x, y;
};

double y_of(const Panel& panel, double texels) {
    const double power = texels > 0 ? std::clamp(log10_of(texels), lowest, highest) : lowest;
    return panel.y + panel_height * (highest - power) / (highest - lowest);
}

double x_of(const Panel& panel, const RangeAxis& axis, std::size_t value) {
    return panel.x + panel_width * (static_cast<double>(value) + 0.5) /
                         static_cast<double>(axis.values.size());
}

std::string axis_text(const Panel& panel, const RangeAxis& axis, const std::string& room) {
    std::string text = fmt::format(
        "<rect x='{}' y='{}' width='{}' height='{}' class='panel'/>\n"
        "<text x='{}' y='{}' class='title'>{}: {}</text>\n",
        panel.x, panel.y, panel_width, panel_height, panel.x, panel.y - 8, room, axis.name);
    for (double power = lowest; power <= highest; power += 4)
        text += fmt::format("<text x='{}' y='{:.1f}' class='left'>1e{:g}</text>\n", panel.x - 5,
                            y_of(panel, 1) + (0 - power) * panel_height / (highest - lowest) + 4,
                            power);
    text += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' class='half'/>\n",
                        panel.x, panel.x + panel_width, y_of(panel, 0.5));
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
        const double x = x_of(panel, axis, i), y = panel.y + panel_height + 12;
        text += fmt::format("<text transform='translate({:.1f},{:.1f}) rotate(45)'>{:g}</text>\n",
                            x - 3, y, axis.values[i]);
    }
    return text;
}

/// A line through the values that are there; a cross where hits are lost.
std::string row_line(const Panel& panel, const RangeAxis& axis, const std::vector<double>& texels,
                     const std::string& colour, const std::string& name) {
    std::string path, crosses;
    bool drawing = false;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double x = x_of(panel, axis, i);
        if (texels[i] < 0) {
            crosses += fmt::format("M{:.1f} {}l5 5m0 -5l-5 5", x - 2.5, panel.y + 4);
            drawing = false;
            continue;
        }
        path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x, y_of(panel, texels[i]));
        drawing = true;
    }
    return fmt::format("<path d='{}{}' stroke='{}'><title>{}</title></path>\n", path, crosses,
                       colour, name);
}

/// Rows from the one that leaves half a texel at the most values on.
std::vector<std::size_t> worst_first(const RangeTable& table) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        double sum = 0;
        for (const auto& axis : table.texels[row])
            for (const double texels : axis)
                sum -= texels < 0
                           ? highest - lowest
                           : std::clamp(log10_of(std::max(texels, 1e-8)), lowest, highest) - lowest;
        order.emplace_back(sum, row);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> rows;
    for (const auto& [sum, row] : order) rows.push_back(row);
    return rows;
}

std::string colour_of(std::size_t rank) { return rank < most_coloured ? colours[rank] : "#c4c4c4"; }

std::string legend(const RangeTable& table, const std::vector<std::size_t>& order, int x, int y) {
    std::string text;
    const std::size_t shown = std::min(order.size(), most_coloured);
    for (std::size_t rank = 0; rank < shown; ++rank, y += 16)
        text +=
            fmt::format("<path d='M{0} {1}h18' stroke='{2}'/><text x='{3}' y='{4}'>{5}</text>\n", x,
                        y, colour_of(rank), x + 24, y + 4, table.rows[order[rank]]);
    if (order.size() > shown)
        text += fmt::format(
            "<path d='M{0} {1}h18' stroke='{2}'/><text x='{3}' y='{4}'>{5} others</text>\n", x, y,
            colour_of(most_coloured), x + 24, y + 4, order.size() - shown);
    text += fmt::format(
        "<path d='M{0} {1}h18' class='half'/><text x='{2}' y='{3}'>half a texel</text>\n", x,
        y + 20, x + 24, y + 24);
    return text +
           fmt::format("<text x='{}' y='{}'>x: fewer than half have hits</text>\n", x, y + 44);
}

}  // namespace

std::string range_plot(const std::vector<RangeTable>& tables) {
    constexpr int columns = 3;
    const auto axes = static_cast<int>(range_axes().size());
    const int lines = (axes + columns - 1) / columns;
    const int width = left + columns * (panel_width + gap_x) + legend_width;
    const int block = lines * (panel_height + gap_y);
    const int height = top + static_cast<int>(tables.size()) * block;
    std::string text = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}'>\n"
        "<style>text{{font:11px sans-serif;fill:#222}}.title{{font-weight:bold}}"
        ".left{{text-anchor:end}}.panel{{fill:#fff;stroke:#888}}"
        ".half{{stroke:#222;stroke-dasharray:4 3;stroke-width:1}}"
        "path{{fill:none;stroke-width:1.6}}</style>\n<rect width='100%' height='100%' "
        "fill='#fafafa'/>\n<text x='{2}' y='16' class='title'>Float from double, in texels of a "
        "map "
        "of 64 x 64: what 99 % of the pixels do not exceed</text>\n",
        width, height, left);
    int y = top;
    for (const RangeTable& table : tables) {
        const std::vector<std::size_t> order = worst_first(table);
        for (int a = 0; a < axes; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            const Panel panel{left + a % columns * (panel_width + gap_x),
                              y + a / columns * (panel_height + gap_y)};
            text += axis_text(panel, range_axes()[axis], table.room);
            for (std::size_t rank = order.size(); rank-- > 0;)
                text += row_line(panel, range_axes()[axis], table.texels[order[rank]][axis],
                                 colour_of(rank), table.rows[order[rank]]);
        }
        text += legend(table, order, left + columns * (panel_width + gap_x), y + 8);
        y += block;
    }
    return text + "</svg>\n";
}

}  // namespace quadrel::stress
