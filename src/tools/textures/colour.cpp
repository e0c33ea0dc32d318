#include "colour.hpp"

#include <algorithm>
#include <array>

#include "quadrel/num/math.hpp"

namespace quadrel::textures {
namespace {

/// Linear values half-way (in the encoded domain) between neighbouring codes.
const std::array<double, 255>& code_limits() {
    static const std::array<double, 255> limits = [] {
        std::array<double, 255> values{};
        for (int code = 0; code < 255; ++code) values[code] = decode_srgb((code + 0.5) / 255);
        return values;
    }();
    return limits;
}

}  // namespace

double decode_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : quadrel::pow((encoded + 0.055) / 1.055, 2.4);
}

int srgb_code(double linear) {
    const auto& limits = code_limits();
    return static_cast<int>(std::upper_bound(limits.begin(), limits.end(), linear) -
                            limits.begin());
}

glm::dvec3 srgb(std::uint32_t rgb) {
    return {decode_srgb((rgb >> 16 & 255) / 255.0), decode_srgb((rgb >> 8 & 255) / 255.0),
            decode_srgb((rgb & 255) / 255.0)};
}

}  // namespace quadrel::textures
