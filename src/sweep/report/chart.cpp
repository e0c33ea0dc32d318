#include "sweep/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "quadrel/num/math.hpp"

namespace quadrel::sweep {
namespace {

constexpr double chart_width = 860, chart_height = 520, chart_left = 74, chart_right = 24,
                 chart_top = 64, chart_bottom = 86;

constexpr const char* chart_style = R"(<style>
text{font:13px system-ui,sans-serif;fill:#333}.title{font-size:17px;font-weight:600;fill:#111}
.note,.tick{font-size:12px;fill:#666}.label{font-size:12px;fill:#222;stroke:#fff;stroke-width:3;paint-order:stroke}.grid{stroke:#e3e3e6}
.axis{stroke:#999}.ground{fill:#fff}.front{stroke:#222;fill:none;stroke-width:1.5;stroke-dasharray:5 4}
.offset{--c:#b86200}.march{--c:#1f63d6}.cone{--c:#0a7f57}.exact{--c:#7a2be8}.table{--c:#8a6d00}.engine{--c:#70757d}
.oracle{--c:#c02556}.other{--c:#444}.dot{fill:var(--c);stroke:#fff;stroke-width:1}
.line{fill:none;stroke:var(--c);stroke-width:2}
@media (prefers-color-scheme:dark){text{fill:#ccc}.title{fill:#fff}.note,.tick{fill:#9a9aa2}
.label{fill:#eee;stroke:#17181c}.grid{stroke:#33343a}.axis{stroke:#777}.ground{fill:#17181c}.front{stroke:#eee}
.dot{stroke:#17181c}.offset{--c:#f0a040}.march{--c:#6ea8ff}.cone{--c:#45cf9c}.exact{--c:#bd93ff}.table{--c:#d9c04a}
.engine{--c:#a5abb5}.oracle{--c:#ff7a9f}.other{--c:#bbb}}
</style>
)";

std::string xml_text(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return safe;
}

double log10_of(double x) { return log2(x) / 3.321928094887362; }

/// One axis: values to pixels.
class Scale {
  public:
    Scale(const Axis& axis, double low, double high, double from, double to)
        : log_(axis.log), from_(from), to_(to) {
        if (!(low < high)) {
            low = log_ ? low / 2 : low - 1;
            high = log_ ? high * 2 : high + 1;
        }
        const double a = map(low), b = map(high), room = 0.06 * (b - a);
        low_ = !log_ && low >= 0 && a - room < 0 ? 0 : a - room;
        high_ = b + room;
    }
    double at(double value) const {
        return from_ + (map(value) - low_) / (high_ - low_) * (to_ - from_);
    }
    /// Values with a line and a number.
    std::vector<double> ticks() const {
        std::vector<double> values;
        if (log_) {
            const bool close = high_ - low_ < 2.2;
            for (int e = static_cast<int>(std::floor(low_)); e <= high_; ++e)
                for (const double m : {1.0, 2.0, 5.0})
                    if (m == 1 || close) add(values, m * power_of_10(e));
            return values;
        }
        const double rough = (high_ - low_) / 6;
        const double power = power_of_10(static_cast<int>(std::floor(log10_of(rough))));
        double step = power;
        for (const double m : {2.0, 5.0, 10.0})
            if (step < rough) step = m * power;
        for (double v = std::ceil(low_ / step) * step; v <= high_; v += step) add(values, v);
        return values;
    }

  private:
    static double power_of_10(int e) {
        double power = 1;
        for (int i = 0; i < std::abs(e); ++i) power *= 10;
        return e < 0 ? 1 / power : power;
    }
    double map(double value) const { return log_ ? log10_of(value) : value; }
    void add(std::vector<double>& values, double v) const {
        if (map(v) >= low_ - 1e-9 && map(v) <= high_ + 1e-9) values.push_back(v);
    }
    bool log_;
    double from_, to_, low_ = 0, high_ = 1;
};

bool fits(const Chart& chart, const ChartPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && (!chart.x.log || p.x > 0) &&
           (!chart.y.log || p.y > 0);
}

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

/// Puts labels where neither another one nor a dot is.
class Labels {
  public:
    void keep_off(double x, double y) { taken_.push_back({x - 5, y - 5, x + 5, y + 5}); }
    /// False where there is no room for it.
    bool add(std::string& svg, double x, double y, const std::string& text) {
        const double wide = 6.6 * static_cast<double>(text.size());
        const bool leftwards = x + 8 + wide > chart_width - chart_right;
        const double x0 = leftwards ? x - 8 - wide : x + 8;
        if (x0 < chart_left) return false;
        for (const double dy : {-6.0, 14.0, -22.0, 30.0, -38.0}) {
            const Box box{x0, y + dy - 11, x0 + wide, y + dy + 3};
            if (box.y1 > chart_height - chart_bottom || box.y0 < chart_top || is_taken(box))
                continue;
            taken_.push_back(box);
            svg += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x0,
                               y + dy, xml_text(text));
            return true;
        }
        return false;
    }

  private:
    struct Box {
        double x0, y0, x1, y1;
    };
    bool is_taken(const Box& b) const {
        return std::any_of(taken_.begin(), taken_.end(), [&](const Box& t) {
            return b.x0 < t.x1 && t.x0 < b.x1 && b.y0 < t.y1 && t.y0 < b.y1;
        });
    }
    std::vector<Box> taken_;
};

class Drawing {
  public:
    explicit Drawing(const Chart& chart) : chart_(chart), x_(scale(true)), y_(scale(false)) {}

    std::string svg() {
        add_axes();
        for (const ChartSeries& series : chart_.series) add_line(series);
        for (const ChartSeries& series : chart_.series) add_dots(series);
        for (const ChartSeries& series : chart_.series) add_labels(series);
        add_legend();
        add_unplaced();
        return head() + text_ + "</svg>\n";
    }

  private:
    static constexpr double line_height = 16;

    /// As high as what has no room beside its point needs.
    std::string head() const {
        const double below =
            unplaced_.empty() ? 0 : line_height * (static_cast<double>(unplaced_.size()) + 1);
        return fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
            "height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n{3}"
            "<rect class=\"ground\" width=\"{0}\" height=\"{1}\"/>\n"
            "<text class=\"title\" x=\"{4}\" y=\"26\">{2}</text>\n"
            "<text class=\"note\" x=\"{4}\" y=\"46\">{5}</text>\n",
            chart_width, chart_height + below, xml_text(chart_.title), chart_style, 20,
            xml_text(chart_.note));
    }

    Scale scale(bool across) const {
        Extent extent;
        for (const ChartSeries& series : chart_.series)
            for (const ChartPoint& p : series.points)
                if (fits(chart_, p)) extent.add(across ? p.x : p.y);
        if (extent.low > extent.high) extent = {1, 10};
        return across
                   ? Scale(chart_.x, extent.low, extent.high, chart_left, chart_width - chart_right)
                   : Scale(chart_.y, extent.low, extent.high, chart_height - chart_bottom,
                           chart_top);
    }

    void add_axes() {
        for (const double v : x_.ticks())
            text_ += fmt::format(
                "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text class=\"tick\" "
                "text-anchor=\"middle\" x=\"{0:.1f}\" y=\"{3}\">{4:g}</text>\n",
                x_.at(v), chart_top, chart_height - chart_bottom, chart_height - chart_bottom + 18,
                v);
        for (const double v : y_.ticks())
            text_ += fmt::format(
                "<path class=\"grid\" d=\"M{1} {0:.1f}H{2}\"/><text class=\"tick\" "
                "text-anchor=\"end\" x=\"{3}\" y=\"{4:.1f}\">{5}{6:g}</text>\n",
                y_.at(v), chart_left, chart_width - chart_right, chart_left - 8, y_.at(v) + 4,
                v <= 1.001 * chart_.y.least ? "\u2264" : "", v);
        text_ += fmt::format("<text text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n",
                             (chart_left + chart_width - chart_right) / 2,
                             chart_height - chart_bottom + 40, xml_text(chart_.x.title));
        text_ += fmt::format(
            "<text text-anchor=\"middle\" transform=\"translate(18 {})rotate(-90)\">"
            "{}</text>\n",
            (chart_top + chart_height - chart_bottom) / 2, xml_text(chart_.y.title));
    }

    void add_line(const ChartSeries& series) {
        if (!series.line && !series.stairs) return;
        std::string path;
        for (const ChartPoint& p : series.points) {
            if (!fits(chart_, p)) continue;
            if (series.stairs && !path.empty()) path += fmt::format("H{:.1f}", x_.at(p.x));
            path +=
                fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_.at(p.x), y_.at(p.y));
        }
        text_ += fmt::format("<path class=\"{} {}\" d=\"{}\"/>\n", series.stairs ? "front" : "line",
                             series.family, path);
    }

    void add_dots(const ChartSeries& series) {
        for (const ChartPoint& p : series.points) {
            if (!fits(chart_, p)) continue;
            if (series.has_marks)
                text_ += fmt::format(
                    "<circle class=\"dot {}\" r=\"5\" cx=\"{:.1f}\" cy=\"{:.1f}\"><title>{}</title>"
                    "</circle>\n",
                    series.family, x_.at(p.x), y_.at(p.y), xml_text(p.about));
            labels_.keep_off(x_.at(p.x), y_.at(p.y));
        }
    }

    void add_labels(const ChartSeries& series) {
        for (const ChartPoint& p : series.points)
            if (fits(chart_, p) && !p.label.empty())
                if (!labels_.add(text_, x_.at(p.x), y_.at(p.y), p.label))
                    unplaced_.push_back(fmt::format("{} ({:.3g}, {:.3g})", p.label, p.x, p.y));
    }

    /// Below the axis: names of points where several lie close together.
    void add_unplaced() {
        double y = chart_height + 4;
        if (unplaced_.empty()) return;
        text_ += fmt::format("<text class=\"note\" x=\"{}\" y=\"{}\">not named above:</text>\n",
                             chart_left, y);
        for (const std::string& line : unplaced_)
            text_ += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text>\n",
                                 chart_left + 12, y += line_height, xml_text(line));
    }

    void add_legend() {
        double x = chart_left;
        std::set<std::string> named;
        for (const ChartSeries& series : chart_.series) {
            if (series.family.empty() || !named.insert(series.family).second) continue;
            text_ += fmt::format(
                "<circle class=\"dot {0}\" r=\"5\" cx=\"{1:.0f}\" cy=\"{2}\"/>"
                "<text x=\"{3:.0f}\" y=\"{4}\">{0}</text>\n",
                series.family, x, chart_height - 18, x + 10, chart_height - 14);
            x += 34 + 7.2 * static_cast<double>(series.family.size());
        }
    }

    const Chart& chart_;
    Scale x_, y_;
    Labels labels_;
    std::vector<std::string> unplaced_;
    std::string text_;
};

}  // namespace

std::string to_svg(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace quadrel::sweep
