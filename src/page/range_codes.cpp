#include "page/range_codes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "quadrel/check.hpp"

namespace quadrel::page {
namespace {

// The same numbers stand in data/page/sources.js.
constexpr std::uint32_t nan_code = 0x2000, inward = 0x1000;
/// A distance is infinite, or `significand` / 8 times a power of two; the first of these is that
/// from the middle of a float's last bit.
constexpr std::uint32_t infinite_code = 1, first_code = 2, octave = 8;
constexpr int first_exponent = -24;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What bounds are told apart from.
float base_of(float value) { return std::isfinite(value) ? value : 0; }

/// The power of two that distances from it are in proportion to; that of the least normal number
/// for what is smaller.
int exponent_of(float base) {
    const int biased = static_cast<int>(std::bit_cast<std::uint32_t>(base) >> 23 & 255);
    return std::max(biased, 1) - 127;
}

double distance_of(std::uint32_t code, int exponent) {
    if (code == 0) return 0;
    if (code == infinite_code) return infinity;
    const std::uint32_t k = code - first_code;
    return std::ldexp(octave + k % octave,
                      static_cast<int>(k / octave) + first_exponent - 3 + exponent);
}

/// The float that is not above x, or not below it.
float rounded(double x, bool down) {
    constexpr float most = std::numeric_limits<float>::max();
    if (std::abs(x) > double{most}) return static_cast<float>(std::copysign(infinity, x));
    const auto nearest = static_cast<float>(x);
    const auto end = static_cast<float>(down ? -infinity : infinity);
    const bool inside = down ? nearest > x : nearest < x;
    return inside ? std::nextafter(nearest, end) : nearest;
}

float bound_of(float base, std::uint32_t code, RangeEnd end) {
    if (code == nan_code) return std::numeric_limits<float>::quiet_NaN();
    const bool low = end == RangeEnd::low, outward = (code & inward) == 0;
    const double distance = distance_of(code & ~inward, exponent_of(base));
    return rounded(low == outward ? base - distance : base + distance, low);
}

bool is_within(float bound, float kept, RangeEnd end) {
    return end == RangeEnd::low ? kept <= bound : kept >= bound;
}

std::uint32_t code_of(float base, float bound, RangeEnd end) {
    if (std::isnan(bound)) return nan_code;
    const double apart = double{bound} - double{base};
    if (apart == 0) return 0;
    const std::uint32_t way = (apart < 0) == (end == RangeEnd::low) ? 0 : inward;
    if (std::isinf(apart)) return infinite_code | way;
    int exponent = 0;
    const double significand = std::frexp(std::abs(apart), &exponent);  // 1/2 to 1
    const int octaves = exponent - 1 - exponent_of(base) - first_exponent;
    std::uint32_t code = first_code + static_cast<std::uint32_t>(octaves) * octave +
                         static_cast<std::uint32_t>(significand * 2 * octave) - octave;
    if (way != 0) {
        while (code >= first_code && !is_within(bound, bound_of(base, code | way, end), end))
            --code;
        return code < first_code ? 0 : code | way;
    }
    while (!is_within(bound, bound_of(base, code, end), end)) ++code;
    return code;
}

}  // namespace

std::vector<std::uint32_t> range_codes(std::span<const float> values, std::span<const float> bounds,
                                       RangeEnd end) {
    QUADREL_CHECK(values.size() == bounds.size(), bounds.size());
    std::vector<std::uint32_t> codes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        codes[i] = code_of(base_of(values[i]), bounds[i], end);
    return codes;
}

std::vector<float> bounds_of_codes(std::span<const float> values,
                                   std::span<const std::uint32_t> codes, RangeEnd end) {
    QUADREL_CHECK(values.size() == codes.size(), codes.size());
    std::vector<float> bounds(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        bounds[i] = bound_of(base_of(values[i]), codes[i], end);
    return bounds;
}

}  // namespace quadrel::page
