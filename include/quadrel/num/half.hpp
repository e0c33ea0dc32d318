// IEEE 754 binary16 ("half") to float and back, without hardware conversions.
#pragma once

#include <bit>
#include <cstdint>

namespace quadrel {

/// The value of a half given by its bits. Exact; a NaN stays a NaN.
inline float half_to_float(std::uint16_t half) {
    const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
    const std::uint32_t magnitude = half & 0x7fffu;
    if (magnitude >= 0x7c00u) {  // infinity, NaN
        return std::bit_cast<float>(sign | 0x7f800000u | ((magnitude & 0x3ffu) << 13));
    }
    // The half's fields read as a float's are its value times 2^-112, denormals included.
    const float scaled = std::bit_cast<float>(magnitude << 13) * 0x1p112f;
    return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(scaled));
}

/// The bits of the nearest half, ties to even; overflow gives infinity, NaN 0x7e00 with its sign.
inline std::uint16_t float_to_half(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) return sign | 0x7e00u;
    if (magnitude >= 0x477ff000u) return sign | 0x7c00u;  // 65520 and above
    if (magnitude < 0x38800000u) {                        // below 2^-14: denormal
        // Adding 1/2, whose ulp is the halves' denormal spacing 2^-24, rounds to it.
        const float rounded = std::bit_cast<float>(magnitude) + 0.5f;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(rounded) & 0x7fffu));
    }
    const std::uint32_t odd = magnitude >> 13 & 1u;
    const std::uint32_t rounded = magnitude - 0x38000000u + 0xfffu + odd;
    return static_cast<std::uint16_t>(sign | rounded >> 13);
}

}  // namespace quadrel
