// Halves: every one of the 65536 against its definition, rounding against exhaustive neighbours.
#include "quadrel/num/half.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "num/inputs.hpp"
#include "num/planted.hpp"

namespace quadrel::num_tests {
namespace {

using ToFloat = float (*)(std::uint16_t);
using ToHalf = std::uint16_t (*)(float);

/// IEEE 754-2008, 3.4: sign, five bits of exponent biased by 15, ten bits of fraction.
double defined_value(int magnitude) {
    const int exponent = magnitude >> 10;
    const int fraction = magnitude & 1023;
    if (exponent == 0) return std::ldexp(fraction, -24);
    return std::ldexp(1024 + fraction, exponent - 25);
}

testing::AssertionResult decodes_every_half(ToFloat decode) {
    for (int h = 0; h < 0x7c00; ++h) {
        const float positive = decode(static_cast<std::uint16_t>(h));
        const float negative = decode(static_cast<std::uint16_t>(h | 0x8000));
        if (positive != defined_value(h) || negative != -defined_value(h) ||
            !std::signbit(negative)) {
            return testing::AssertionFailure() << std::hex << h << " is " << positive;
        }
    }
    const float infinity = std::numeric_limits<float>::infinity();
    if (decode(0x7c00) != infinity || decode(0xfc00) != -infinity || !std::isnan(decode(0x7c01))) {
        return testing::AssertionFailure() << "infinities or NaN";
    }
    return testing::AssertionSuccess();
}

/// Between neighbours h and h + 1: below the middle h, above h + 1, on it the even one.
testing::AssertionResult rounds_to_nearest_even(ToHalf encode) {
    for (int h = 0; h < 0x7c00; ++h) {
        const double below = defined_value(h);
        const double above = defined_value(h + 1);  // 65536 stands for infinity
        const auto middle = static_cast<float>((below + above) / 2);
        const int even = h + (h & 1);
        const int found[] = {encode(static_cast<float>(below)),
                             encode(std::nextafter(middle, 0.0f)), encode(middle),
                             encode(std::nextafter(middle, 1e6f)), encode(-middle)};
        const int expected[] = {h, h, even, h + 1, even | 0x8000};
        for (int i = 0; i < 5; ++i) {
            if (found[i] != expected[i]) {
                return testing::AssertionFailure()
                       << std::hex << "near half " << h << ": case " << i << " gives " << found[i]
                       << ", expected " << expected[i];
            }
        }
    }
    const float infinity = std::numeric_limits<float>::infinity();
    const bool specials = encode(infinity) == 0x7c00 && encode(-infinity) == 0xfc00 &&
                          encode(3e38f) == 0x7c00 && encode(1e-30f) == 0 &&
                          encode(-0.0f) == 0x8000 && encode(std::nanf("")) == 0x7e00;
    return specials ? testing::AssertionSuccess() : testing::AssertionFailure() << "specials";
}

TEST(Half, DecodesEveryValue) { EXPECT_TRUE(decodes_every_half(half_to_float)); }
TEST(Half, RoundsToNearestEven) { EXPECT_TRUE(rounds_to_nearest_even(float_to_half)); }

TEST(Half, CatchesPlantedErrors) {
    EXPECT_FALSE(rounds_to_nearest_even([](float x) {
        const auto bits = std::bit_cast<std::uint32_t>(x) & 0x7fffffffu;
        if (bits < 0x38800000u || bits >= 0x477ff000u) return float_to_half(x);
        const auto sign = static_cast<std::uint16_t>(x < 0 ? 0x8000u : 0u);
        return static_cast<std::uint16_t>(sign | (bits - 0x38000000u + 0x1000u) >> 13);
    })) << static_cast<int>(Planted::half_rounds_up);
    EXPECT_FALSE(decodes_every_half([](std::uint16_t h) {
        return (h & 0x7c00u) == 0 ? 0.0f : half_to_float(h);
    })) << static_cast<int>(Planted::half_drops_denormals);
}

}  // namespace
}  // namespace quadrel::num_tests
