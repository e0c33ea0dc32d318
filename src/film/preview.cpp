#include "quadrel/film/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "film/preview_group.hpp"
#include "quadrel/check.hpp"

namespace quadrel {
namespace {

/// x^0.4 of x in (0, 1], as the fifth root of x^2 by Newton's method, whose convergence from above
/// is monotonic. The sign of the last step ends it.
double power_two_fifths(double x) {
    const double square = x * x;
    double root = 1;
    for (int i = 0; i < 100; ++i) {
        const double fourth = root * root * root * root;
        const double next = (4 * root + square / fourth) / 5;
        if (!(next < root)) break;
        root = next;
    }
    return root;
}

/// IEC 61966-2-1: from a code value in [0, 1] to linear light.
double srgb_to_linear(double code) {
    if (code <= 0.04045) return code / 12.92;
    const double x = (code + 0.055) / 1.055;
    return x * x * power_two_fifths(x);
}

/// Linear values half-way (in code space) between two codes: threshold[c] parts c and c + 1.
std::array<double, 255> make_thresholds() {
    std::array<double, 255> thresholds;
    for (int c = 0; c < 255; ++c)
        thresholds[static_cast<std::size_t>(c)] = srgb_to_linear((c + 0.5) / 255);
    return thresholds;
}

bool is_nan(const Plane& plane, std::size_t i) {
    return plane.type == ChannelType::float32 && std::isnan(plane.as_float(i));
}

double value_of(const Plane& plane, std::size_t i) {
    return plane.type == ChannelType::uint32 ? static_cast<double>(plane.bits[i])
                                             : static_cast<double>(plane.as_float(i));
}

bool all_zero(const std::vector<const Plane*>& planes, std::size_t i) {
    return std::all_of(planes.begin(), planes.end(),
                       [i](const Plane* plane) { return value_of(*plane, i) == 0; });
}

/// What is shown as 0 and as 255 where values are spread.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    double share(double value) const {
        const double span = high > low ? high - low : 1;
        return std::clamp((value - low) / span, 0.0, 1.0);
    }
};

/// Of the finite values; those of uncovered pixels do not count where there are other components.
Range finite_range(const Plane& plane, const std::vector<const Plane*>& group) {
    Range range;
    for (std::size_t i = 0; i < plane.bits.size(); ++i) {
        const double value = value_of(plane, i);
        if (!std::isfinite(value) || (group.size() > 1 && all_zero(group, i))) continue;
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    }
    return range;
}

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::isnan(share) ? 255 : share * 255 + 0.5);
}

/// How the values of a group become colours.
enum class Shown { light, unit_vector, unit_range, fraction, spread };

Shown how_shown(const PreviewGroup& group) {
    const std::string& name = group.name;
    if (group.planes.size() == 1) return Shown::spread;
    if (name.empty() || name.starts_with("light.")) return Shown::light;
    if (name == "N" || name == "Ng") return Shown::unit_vector;
    if (name == "bary") return Shown::unit_range;
    return name == "uv" || name == "hit" ? Shown::fraction : Shown::spread;
}

std::uint8_t code_of_value(Shown shown, double value, const Range& range) {
    switch (shown) {
        case Shown::light:
            return srgb_code(static_cast<float>(value));
        case Shown::unit_vector:
            return byte_of(std::clamp(0.5 * value + 0.5, 0.0, 1.0));
        case Shown::unit_range:
            return byte_of(std::clamp(value, 0.0, 1.0));
        case Shown::fraction:
            return byte_of(value - std::floor(value));
        case Shown::spread:
            break;
    }
    return byte_of(range.share(value));
}

/// One component in gray; of several, the first in red and so on.
Picture draw_group(const Film& film, const PreviewGroup& group) {
    Picture picture(film.window.width(), film.window.height(), 0);
    const Shown shown = how_shown(group);
    const bool gray = group.planes.size() == 1;
    std::vector<Range> ranges(group.planes.size());
    if (shown == Shown::spread)
        for (std::size_t c = 0; c < ranges.size(); ++c)
            ranges[c] = finite_range(*group.planes[c], group.planes);
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        std::uint8_t* const rgb = &picture.rgb[3 * i];
        if (!gray && shown != Shown::light && all_zero(group.planes, i)) continue;
        bool nan = false;
        for (std::size_t c = 0; c < (gray ? 3 : group.planes.size()); ++c) {
            const std::size_t component = gray ? 0 : c;
            const Plane& plane = *group.planes[component];
            nan |= is_nan(plane, i);
            rgb[c] = code_of_value(shown, value_of(plane, i), ranges[component]);
        }
        if (!nan) continue;
        rgb[0] = rgb[2] = 255;
        rgb[1] = 0;
    }
    return picture;
}

}  // namespace

Picture::Picture(int width_, int height_, std::uint8_t gray)
    : width(width_),
      height(height_),
      rgb(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), gray) {}

void Picture::set(int x, int y, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    rgb[i] = r;
    rgb[i + 1] = g;
    rgb[i + 2] = b;
}

std::uint8_t srgb_code(float linear) {
    static const std::array<double, 255> thresholds = make_thresholds();
    if (std::isnan(linear)) return 0;
    const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), double{linear});
    return static_cast<std::uint8_t>(above - thresholds.begin());
}

Picture preview(const Film& film) {
    QUADREL_CHECK(!film.planes.empty(), film.planes.size());
    return draw_group(film, preview_group(film));
}

bool previews_rows(const Film& film) { return how_shown(preview_group(film)) != Shown::spread; }

std::vector<std::string> preview_channels(const Film& film) {
    std::vector<std::string> names;
    for (const Plane* plane : preview_group(film).planes) names.push_back(plane->name);
    return names;
}

}  // namespace quadrel
