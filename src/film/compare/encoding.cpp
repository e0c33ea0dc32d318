#include <bit>
#include <cmath>
#include <cstdlib>

#include "quadrel/film/encoding.hpp"
#include "quadrel/film/preview.hpp"
#include "quadrel/num/half.hpp"

namespace quadrel {
namespace {

constexpr Encoding encodings[] = {Encoding::none, Encoding::half, Encoding::unorm8,
                                  Encoding::srgb8};

/// Exact before the rounding: 24 bits times 8 bits fit a double.
int unorm8_code(float value) {
    const double scaled = double{value} * 255;
    if (!(scaled > 0)) return 0;
    return scaled >= 255 ? 255 : static_cast<int>(scaled + 0.5);
}

/// Sign and magnitude as a point on a line; both zeros are 0.
std::int64_t on_line(std::uint32_t magnitude, bool negative) {
    return negative ? -std::int64_t{magnitude} : std::int64_t{magnitude};
}

std::int64_t float_on_line(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return on_line(bits & 0x7fffffffu, (bits >> 31) != 0);
}

std::int64_t half_on_line(float value) {
    const std::uint32_t bits = float_to_half(value);
    return on_line(bits & 0x7fffu, (bits >> 15) != 0);
}

std::int64_t on_line(Encoding encoding, float value) {
    if (encoding == Encoding::none) return float_on_line(value);
    return encoding == Encoding::half ? half_on_line(value) : std::int64_t{code_of(value)};
}

}  // namespace

const char* encoding_name(Encoding encoding) {
    switch (encoding) {
        case Encoding::none:
            return "none";
        case Encoding::half:
            return "half";
        case Encoding::unorm8:
            return "unorm8";
        case Encoding::srgb8:
            break;
    }
    return "srgb8";
}

std::optional<Encoding> parse_encoding(const std::string& name) {
    for (const Encoding encoding : encodings)
        if (name == encoding_name(encoding)) return encoding;
    return std::nullopt;
}

float encode(Encoding encoding, float value) {
    if (std::isnan(value) || encoding == Encoding::none) return value;
    if (encoding == Encoding::half) return half_to_float(float_to_half(value));
    const int code = encoding == Encoding::srgb8 ? int{srgb_code(value)} : unorm8_code(value);
    return static_cast<float>(code) / 255.0f;
}

int code_of(float encoded) { return unorm8_code(encoded); }

std::uint32_t ulp_distance(float a, float b) { return ulp_distance(Encoding::none, a, b); }

std::uint32_t ulp_distance(Encoding encoding, float a, float b) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : no_distance;
    return static_cast<std::uint32_t>(std::abs(on_line(encoding, a) - on_line(encoding, b)));
}

}  // namespace quadrel
