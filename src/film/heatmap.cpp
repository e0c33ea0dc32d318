#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "quadrel/error.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

constexpr double incomparable = std::numeric_limits<double>::infinity();

double difference(ChannelType type, std::uint32_t a, std::uint32_t b) {
    if (a == b) return 0;
    if (type == ChannelType::uint32) return std::abs(static_cast<double>(a) - b);
    const double x = std::bit_cast<float>(a), y = std::bit_cast<float>(b);
    if (std::isnan(x) && std::isnan(y)) return 0;
    if (!std::isfinite(x) || !std::isfinite(y)) return incomparable;
    return std::abs(x - y);
}

/// log2 of a positive double with a straight line between powers of two: enough for a colour.
double rough_log2(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return exponent - 1 + (2 * mantissa - 1);
}

std::uint8_t byte(double value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
}

void paint(Picture& picture, int x, int y, double error) {
    if (error == 0) return;
    if (error == incomparable) return picture.set(x, y, 255, 0, 255);
    const double heat = std::clamp((rough_log2(error) + 24) / 24, 0.0, 1.0);
    picture.set(x, y, byte(2.5 * heat - 0.25), byte(2.5 * heat - 1.25),
                byte(heat < 0.4   ? 0.3 + heat
                     : heat < 0.7 ? 1.4 - 2 * heat
                                  : 3.4 * heat - 2.4));
}

std::vector<double> largest_differences(const Film& reference, const Film& test) {
    std::vector<double> errors(reference.window.area(), 0.0);
    for (const Plane& plane : reference.planes) {
        const Plane* other = test.find(plane.name);
        if (other == nullptr || other->type != plane.type) continue;
        for (std::size_t i = 0; i < errors.size(); ++i)
            errors[i] = std::max(errors[i], difference(plane.type, plane.bits[i], other->bits[i]));
    }
    return errors;
}

}  // namespace

Picture heatmap(const Film& reference, const Film& test) {
    if (reference.window != test.window) throw UsageError("heat map: the windows differ");
    const std::vector<double> errors = largest_differences(reference, test);
    Picture picture(reference.window.width(), reference.window.height(), 0);
    std::size_t i = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) paint(picture, x, y, errors[i++]);
    return picture;
}

}  // namespace quadrel
