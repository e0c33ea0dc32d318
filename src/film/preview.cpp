#include "quadrel/film/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

Picture color_preview(const Film& film, const Plane& r, const Plane& g, const Plane& b) {
    Picture picture(film.window.width(), film.window.height(), 0);
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        const float values[3] = {r.as_float(i), g.as_float(i), b.as_float(i)};
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = srgb_code(values[c]);
        if (std::isnan(values[0]) || std::isnan(values[1]) || std::isnan(values[2])) {
            picture.rgb[3 * i] = picture.rgb[3 * i + 2] = 255;
            picture.rgb[3 * i + 1] = 0;
        }
    }
    return picture;
}

double value_of(const Plane& plane, std::size_t i) {
    return plane.type == ChannelType::uint32 ? static_cast<double>(plane.bits[i])
                                             : static_cast<double>(plane.as_float(i));
}

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

Range finite_range(const Plane& plane) {
    Range range;
    for (std::size_t i = 0; i < plane.bits.size(); ++i) {
        const double value = value_of(plane, i);
        if (!std::isfinite(value)) continue;
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    }
    return range;
}

Picture gray_preview(const Film& film, const Plane& plane) {
    Picture picture(film.window.width(), film.window.height(), 0);
    const Range range = finite_range(plane);
    const double span = range.high > range.low ? range.high - range.low : 1;
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        const double value = value_of(plane, i);
        const double share = std::clamp((value - range.low) / span, 0.0, 1.0);
        const bool nan = std::isnan(value);
        const auto gray = static_cast<std::uint8_t>(std::isnan(share) ? 255 : share * 255 + 0.5);
        picture.rgb[3 * i] = picture.rgb[3 * i + 2] = nan ? std::uint8_t{255} : gray;
        picture.rgb[3 * i + 1] = nan ? std::uint8_t{0} : gray;
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
    const Plane* r = film.find("R");
    const Plane* g = film.find("G");
    const Plane* b = film.find("B");
    if (r == nullptr || g == nullptr || b == nullptr) return gray_preview(film, film.planes[0]);
    return color_preview(film, *r, *g, *b);
}

}  // namespace quadrel
