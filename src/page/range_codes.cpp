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
constexpr int significant_bits = 4;  // 8 to 15
constexpr std::uint64_t first_rounded = 1u << significant_bits, half = first_rounded / 2;
constexpr std::int64_t infinity_on_line = 0x7f800000;

/// Floats in their order, 0 and -0 in one place; infinities are the ends.
std::int64_t on_line(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::int64_t size = bits & 0x7fffffffu;
    return bits >> 31 != 0 ? -size : size;
}

float from_line(std::int64_t place) {
    const std::int64_t at = std::clamp(place, -infinity_on_line, infinity_on_line);
    const auto size = static_cast<std::uint32_t>(at < 0 ? -at : at);
    return std::bit_cast<float>(at < 0 ? size | 0x80000000u : size);
}

/// Small distances by themselves, larger ones by their first bits, rounded up or down.
std::uint32_t distance_code(std::uint64_t distance, bool up) {
    if (distance < first_rounded) return static_cast<std::uint32_t>(distance);
    const int shift = static_cast<int>(std::bit_width(distance)) - significant_bits;
    std::uint64_t first_bits = distance >> shift;
    if (up && first_bits << shift != distance) ++first_bits;  // 16 is the next octave's 8
    return static_cast<std::uint32_t>(first_rounded + half * static_cast<unsigned>(shift - 1) +
                                      first_bits - half);
}

std::uint64_t distance_of(std::uint32_t code) {
    if (code < first_rounded) return code;
    const std::uint64_t above = code - first_rounded;
    return (half + above % half) << (above / half + 1);
}

std::int64_t base_of(float value) { return std::isnan(value) ? 0 : on_line(value); }

}  // namespace

std::vector<std::uint32_t> range_codes(std::span<const float> values, std::span<const float> bounds,
                                       RangeEnd end) {
    QUADREL_CHECK(values.size() == bounds.size(), bounds.size());
    std::vector<std::uint32_t> codes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(bounds[i])) {
            codes[i] = nan_code;
            continue;
        }
        const std::int64_t apart = on_line(bounds[i]) - base_of(values[i]);
        const bool outward = end == RangeEnd::low ? apart <= 0 : apart >= 0;
        codes[i] = distance_code(static_cast<std::uint64_t>(apart < 0 ? -apart : apart), outward) |
                   (outward ? 0 : inward);
    }
    return codes;
}

std::vector<float> bounds_of_codes(std::span<const float> values,
                                   std::span<const std::uint32_t> codes, RangeEnd end) {
    QUADREL_CHECK(values.size() == codes.size(), codes.size());
    std::vector<float> bounds(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (codes[i] == nan_code) {
            bounds[i] = std::numeric_limits<float>::quiet_NaN();
            continue;
        }
        const bool outward = (codes[i] & inward) == 0;
        const auto distance = static_cast<std::int64_t>(distance_of(codes[i] & ~inward));
        const bool down = (end == RangeEnd::low) == outward;
        bounds[i] = from_line(base_of(values[i]) + (down ? -distance : distance));
    }
    return bounds;
}

}  // namespace quadrel::page
