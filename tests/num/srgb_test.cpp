// The sRGB transfer function: vectors of IEC 61966-2-1, round trips of every 8-bit code.
#include "quadrel/num/srgb.hpp"

#include <gtest/gtest.h>

#include "num/planted.hpp"

namespace quadrel::num_tests {
namespace {

using Decode = double (*)(double);

double decode(double code) { return srgb_decode(code); }

/// The standard's two pieces, the power computed as x^2 * (x^(1/5))^2 by Newton's iteration.
double defined_decode(double code) {
    if (code <= 0.04045) return code / 12.92;
    const double x = (code + 0.055) / 1.055;
    double root = x;
    for (int i = 0; i < 60; ++i)
        root -= (root * root * root * root * root - x) / (5 * root * root * root * root);
    return x * x * root * root;
}

testing::AssertionResult decodes_as_defined(Decode tested) {
    for (int code = 0; code <= 65535; ++code) {
        const double c = code / 65535.0;
        const double expected = defined_decode(c);
        if (abs(tested(c) - expected) > 1e-14 * expected) {
            return testing::AssertionFailure() << "code " << c << " gives " << tested(c);
        }
    }
    return testing::AssertionSuccess();
}
testing::AssertionResult round_trips(Decode tested) {
    for (int code = 0; code <= 255; ++code) {
        const double again = srgb_encode(tested(code / 255.0)) * 255;
        // At the joint the standard's two thresholds differ by 2e-8 of the range.
        if (abs(again - code) > 1e-5) return testing::AssertionFailure() << code << ": " << again;
    }
    return testing::AssertionSuccess();
}

TEST(Srgb, DecodesAsDefined) { EXPECT_TRUE(decodes_as_defined(decode)); }
TEST(Srgb, RoundTripsEveryCode) {
    EXPECT_TRUE(round_trips(decode));
    for (int code = 0; code <= 255; ++code) {
        const float again = srgb_encode(srgb_decode(static_cast<float>(code) / 255.0f)) * 255.0f;
        EXPECT_EQ(round_even(again), static_cast<float>(code));
    }
}
TEST(Srgb, KeepsTheEnds) {
    EXPECT_EQ(srgb_decode(0.0), 0.0);
    EXPECT_EQ(srgb_decode(1.0), 1.0);
    EXPECT_EQ(srgb_encode(0.0), 0.0);
    EXPECT_NEAR(srgb_encode(1.0), 1.0, 1e-15);
    EXPECT_TRUE(is_nan(srgb_decode(std::numeric_limits<double>::quiet_NaN())));
}
TEST(Srgb, CatchesPlantedErrors) {
    EXPECT_FALSE(decodes_as_defined([](double c) { return pow((c + 0.055) / 1.055, 2.4); }))
        << static_cast<int>(Planted::srgb_without_toe);
    EXPECT_FALSE(round_trips([](double c) { return pow(c, 2.2); }))
        << static_cast<int>(Planted::srgb_gamma_22);
}

}  // namespace
}  // namespace quadrel::num_tests
