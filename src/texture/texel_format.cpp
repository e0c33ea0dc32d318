#include "texture/texel_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "quadrel/num/srgb.hpp"

namespace quadrel {

int max_code(TexelFormat format) {
    switch (format) {
        case TexelFormat::unorm8:
        case TexelFormat::srgb8:
            return 255;
        case TexelFormat::unorm16:
            return 65535;
        case TexelFormat::half:
        case TexelFormat::float32:
            break;
    }
    return 0;
}

std::string_view format_name(TexelFormat format) {
    return std::find_if(std::begin(named_formats), std::end(named_formats),
                        [&](const auto& named) { return named.second == format; })
        ->first;
}

double round_to_half(double x) {
    if (!std::isfinite(x) || x == 0) return x;
    constexpr int min_exponent = -14, fraction_bits = 10;
    const int exponent = std::max(std::ilogb(x), min_exponent);
    const double quantum = std::ldexp(1.0, exponent - fraction_bits);
    const double rounded = std::nearbyint(x / quantum) * quantum;
    constexpr double largest = 65504;
    return std::fabs(rounded) <= largest
               ? rounded
               : std::copysign(std::numeric_limits<double>::infinity(), x);
}

int encode_unorm(double value, double unit, int max) {
    const double scaled = value * max / unit;
    if (!(scaled > 0)) return 0;
    return scaled >= max ? max : static_cast<int>(scaled + 0.5);
}

namespace {

float decode_srgb8(int code) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> decoded{};
        for (int i = 0; i < 256; ++i) decoded[i] = static_cast<float>(srgb_decode(i / 255.0));
        return decoded;
    }();
    return table[code];
}

/// Linear values at which one code gives way to the next: decoded half codes.
const std::array<double, 255>& srgb8_thresholds() {
    static const std::array<double, 255> table = [] {
        std::array<double, 255> linear{};
        for (int i = 0; i < 255; ++i) linear[i] = srgb_decode((i + 0.5) / 255);
        return linear;
    }();
    return table;
}

}  // namespace

int encode_srgb8(double linear) {
    if (std::isnan(linear)) return 0;
    const auto& thresholds = srgb8_thresholds();
    const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), linear);
    return static_cast<int>(above - thresholds.begin());
}

float store_and_decode(double value, double unit, TexelFormat format, bool is_alpha) {
    if (format == TexelFormat::float32) return static_cast<float>(value / unit);
    if (format == TexelFormat::half) return static_cast<float>(round_to_half(value / unit));
    const int max = max_code(format);
    if (format == TexelFormat::srgb8 && !is_alpha) {
        return decode_srgb8(encode_srgb8(value / unit));
    }
    // By division: the product with the reciprocal misses 126 of 256 codes.
    return static_cast<float>(encode_unorm(value, unit, max)) / static_cast<float>(max);
}

}  // namespace quadrel
