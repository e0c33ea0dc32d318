#include "quadrel/film/heatmap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "film/draw.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

constexpr double incomparable = std::numeric_limits<double>::infinity();
constexpr HeatKind kinds[] = {HeatKind::colour, HeatKind::value, HeatKind::count, HeatKind::code};

/// What a panel says of itself.
struct KindText {
    const char *name, *measure, *scale;
};

KindText text_of(HeatKind kind) {
    switch (kind) {
        case HeatKind::colour:
            return {"colours", "error", "6e-8 to 1 or more, black: equal, magenta: NaN, infinite"};
        case HeatKind::value:
            return {"values", "error / max(1, reference)",
                    "6e-8 to 1 or more, black: equal, magenta: NaN, infinite"};
        case HeatKind::count:
            return {"counts", "difference", "1 to 256 or more, black: equal"};
        case HeatKind::code:
            break;
    }
    return {"codes", "another code", "orange: other, black: equal"};
}

/// Powers of two at which a scale begins and ends.
struct Scale {
    double low, high;
};

Scale scale_of(HeatKind kind) { return kind == HeatKind::count ? Scale{-1, 8} : Scale{-24, 0}; }

double difference(HeatKind kind, ChannelType type, std::uint32_t a, std::uint32_t b) {
    if (a == b) return 0;
    if (kind == HeatKind::code) return 1;
    if (type == ChannelType::uint32) return std::abs(static_cast<double>(a) - b);
    const double x = std::bit_cast<float>(a), y = std::bit_cast<float>(b);
    if (std::isnan(x) && std::isnan(y)) return 0;
    if (!std::isfinite(x) || !std::isfinite(y)) return incomparable;
    return std::abs(x - y) / (kind == HeatKind::value ? std::max(1.0, std::abs(x)) : 1.0);
}

/// log2 of a positive double with a straight line between powers of two: enough for a colour.
double rough_log2(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return exponent - 1 + (2 * mantissa - 1);
}

void paint(Picture& picture, int x, int y, HeatKind kind, double error) {
    if (error == 0) return;
    if (error == incomparable) return picture.set(x, y, 255, 0, 255);
    if (kind == HeatKind::code) return picture.set(x, y, 255, 160, 0);
    const Scale scale = scale_of(kind);
    const double share = (rough_log2(error) - scale.low) / (scale.high - scale.low);
    paint_heat(picture, x, y, std::clamp(share, 0.0, 1.0));
}

void raise(HeatPanel& panel, std::vector<double>& errors, const Plane& a, const Plane& b) {
    for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] = std::max(errors[i], difference(panel.kind, a.type, a.bits[i], b.bits[i]));
    panel.channels.push_back(a.name);
}

HeatPanel make_panel(HeatKind kind, const Film& reference, const Film& test) {
    HeatPanel panel{kind, {}, Picture(reference.window.width(), reference.window.height(), 0)};
    std::vector<double> errors(reference.window.area(), 0.0);
    for (const Plane& plane : reference.planes) {
        const Plane* other = test.find(plane.name);
        if (other == nullptr || other->type != plane.type) continue;
        if (heat_kind(plane.name, plane.type) == kind) raise(panel, errors, plane, *other);
    }
    std::size_t i = 0;
    for (int y = 0; y < panel.picture.height; ++y)
        for (int x = 0; x < panel.picture.width; ++x) paint(panel.picture, x, y, kind, errors[i++]);
    return panel;
}

bool has_kind(HeatKind kind, const Film& reference, const Film& test) {
    return std::any_of(reference.planes.begin(), reference.planes.end(), [&](const Plane& plane) {
        const Plane* other = test.find(plane.name);
        return other != nullptr && other->type == plane.type &&
               heat_kind(plane.name, plane.type) == kind;
    });
}

constexpr int panel_margin = 4, bar_height = 8, least_width = 222;

/// The scale from its low end to its high one.
Picture scale_bar(HeatKind kind, int width) {
    Picture bar(width, bar_height, 0);
    for (int y = 0; y < bar.height; ++y)
        for (int x = 0; x < width; ++x) {
            if (kind == HeatKind::code)
                bar.set(x, y, 255, 160, 0);
            else
                paint_heat(bar, x, y, (x + 0.5) / width);
        }
    return bar;
}

std::vector<std::string> captions(const HeatPanel& panel, int width) {
    const KindText text = text_of(panel.kind);
    std::string channels;
    for (const std::string& name : panel.channels) channels += " " + name;
    std::vector<std::string> lines = text_lines(text.name + (":" + channels), width);
    for (const std::string& line : text_lines(std::string(text.measure) + " " + text.scale, width))
        lines.push_back(line);
    return lines;
}

/// A panel over its scale and its text.
Picture with_legend(const HeatPanel& panel) {
    const int width = std::max(panel.picture.width, least_width);
    const std::vector<std::string> lines = captions(panel, width);
    const int below = panel.picture.height + panel_margin;
    Picture whole(
        width,
        below + bar_height + panel_margin + static_cast<int>(lines.size()) * text_line_height,
        paper);
    draw_picture(whole, 0, 0, panel.picture);
    draw_picture(whole, 0, below, scale_bar(panel.kind, least_width));
    int top = below + bar_height + panel_margin;
    for (const std::string& line : lines) {
        draw_label(whole, 0, top, width, line);
        top += text_line_height;
    }
    return whole;
}

}  // namespace

HeatKind heat_kind(const std::string& channel, ChannelType type) {
    const auto starts = [&](const char* prefix) { return channel.starts_with(prefix); };
    for (const char* name : {"R", "G", "B", "A", "Y", "occlusion"})
        if (channel == name) return HeatKind::colour;
    if (starts("light.") || channel.ends_with(".visibility")) return HeatKind::colour;
    const ChannelInfo* info = find_channel(channel);
    if (info == nullptr || info->type != ChannelType::uint32)
        return type == ChannelType::uint32 ? HeatKind::code : HeatKind::value;
    return info->unit == "count" ? HeatKind::count : HeatKind::code;
}

std::vector<HeatPanel> heat_panels(const Film& reference, const Film& test) {
    if (reference.window != test.window) throw UsageError("heat map: the windows differ");
    std::vector<HeatPanel> panels;
    for (const HeatKind kind : kinds)
        if (has_kind(kind, reference, test)) panels.push_back(make_panel(kind, reference, test));
    return panels;
}

Picture heatmap(const Film& reference, const Film& test) {
    std::vector<Picture> pictures;
    for (const HeatPanel& panel : heat_panels(reference, test))
        pictures.push_back(with_legend(panel));
    int width = panel_margin, height = 0;
    for (const Picture& picture : pictures) {
        width += picture.width + panel_margin;
        height = std::max(height, picture.height);
    }
    Picture all(width, height + 2 * panel_margin, paper);
    int left = panel_margin;
    for (const Picture& picture : pictures) {
        draw_picture(all, left, panel_margin, picture);
        left += picture.width + panel_margin;
    }
    return all;
}

}  // namespace quadrel
