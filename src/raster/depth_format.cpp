#include "quadrel/raster/depth_format.hpp"

#include <bit>
#include <cmath>

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

int bits(DepthFormat format) { return format == DepthFormat::unorm16 ? 16 : 24; }

}  // namespace

std::uint32_t max_depth_code(DepthFormat format) {
    QUADREL_CHECK(format != DepthFormat::float32, static_cast<int>(format));
    return (1u << bits(format)) - 1;
}

std::uint32_t depth_code(DepthFormat format, float depth) {
    const float clamped = depth >= 0 ? (depth > 1 ? 1.0f : depth) : 0.0f;
    if (format == DepthFormat::float32) return std::bit_cast<std::uint32_t>(clamped);
    // 24 bits times 24 bits: the product is exact in double.
    return static_cast<std::uint32_t>(std::floor(double(clamped) * max_depth_code(format) + 0.5));
}

double depth_bias_unit(DepthFormat format, float largest_depth) {
    if (format != DepthFormat::float32) return std::ldexp(1.0, -bits(format));
    QUADREL_CHECK(largest_depth > 0, largest_depth);
    int exponent = 0;  // largest_depth = m 2^exponent, m in [0.5, 1)
    std::frexp(largest_depth, &exponent);
    return std::ldexp(1.0, exponent - 1 - 23);
}

}  // namespace quadrel
