#include "colour.hpp"

#include <algorithm>
#include <array>

#include "quadrel/num/srgb.hpp"

namespace quadrel::textures {
namespace {

/// Linear values half-way (in the encoded domain) between neighbouring codes.
const std::array<double, 255>& code_limits() {
    static const std::array<double, 255> limits = [] {
        std::array<double, 255> values{};
        for (int code = 0; code < 255; ++code) values[code] = srgb_decode((code + 0.5) / 255);
        return values;
    }();
    return limits;
}

}  // namespace

int srgb_code(double linear) {
    const auto& limits = code_limits();
    return static_cast<int>(std::upper_bound(limits.begin(), limits.end(), linear) -
                            limits.begin());
}

double linear_of_code(int code) { return srgb_decode(code / 255.0); }

glm::dvec3 srgb(std::uint32_t rgb) {
    const auto channel = [rgb](int shift) { return linear_of_code(rgb >> shift & 255); };
    return {channel(16), channel(8), channel(0)};
}

}  // namespace quadrel::textures
