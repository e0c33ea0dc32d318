// Ends of ranges as small numbers: never inwards, never far outwards.
#include "page/range_codes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "page/planted.hpp"
#include "random.hpp"

namespace quadrel::page_tests {
namespace {

using page::RangeEnd;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Whether `kept` is a bound in the place of `bound`.
testing::AssertionResult stands_for(float kept, float bound, float value, RangeEnd end) {
    const auto failure = testing::AssertionFailure()
                         << kept << " for " << bound << " beside " << value;
    if (std::isnan(bound) || std::isnan(kept))
        return std::isnan(bound) && std::isnan(kept) ? testing::AssertionSuccess() : failure;
    if (!std::isfinite(bound)) return kept == bound ? testing::AssertionSuccess() : failure;
    const bool low = end == RangeEnd::low;
    const double base = std::isfinite(value) ? value : 0, apart = std::abs(bound - base);
    const double farthest = low ? bound - apart / 8 : bound + apart / 8;
    const float inner = std::nextafter(kept, static_cast<float>(base));  // ends are floats
    const bool near = std::isinf(kept) ? std::abs(farthest) > std::numeric_limits<float>::max()
                      : low            ? inner >= farthest || kept == bound
                                       : inner <= farthest || kept == bound;
    const bool outwards = low ? kept <= bound : kept >= bound;
    return outwards && near ? testing::AssertionSuccess() : failure;
}

/// Keeps bounds of values of all sizes; `defect` changes what is kept.
template <class Defect>
testing::AssertionResult keeps_bounds(const Defect& defect) {
    test::Random random(11);
    std::vector<float> values = {0, -0.0f, 1, nan_value, nan_value, infinity, -infinity, 3};
    std::vector<float> bounds = {0, 0, nan_value, nan_value, -2, infinity, -infinity, -infinity};
    // Beside 0 floats lie so densely that a share of their number is many times the distance.
    for (const float apart : {1e-45f, 3e-39f, 1e-20f, 1e-6f, 0.3f, 3e38f})
        for (const float value : {0.0f, 1e-30f, -1e-6f})
            for (const float sign : {1.0f, -1.0f}) {
                values.push_back(value);
                bounds.push_back(value + sign * apart);
            }
    for (int i = 0; i < 4000; ++i) {
        const auto bits = static_cast<std::uint32_t>(random.bits());
        const float value = std::bit_cast<float>(bits);
        const auto apart = static_cast<std::uint32_t>(random.bits()) >> (random.bits() % 32);
        values.push_back(value);
        bounds.push_back(i % 2 == 0 ? std::bit_cast<float>(bits + apart)
                                    : std::bit_cast<float>(bits - apart));
    }
    for (const RangeEnd end : {RangeEnd::low, RangeEnd::high}) {
        const auto kept =
            page::bounds_of_codes(values, page::range_codes(values, bounds, end), end);
        for (std::size_t i = 0; i < values.size(); ++i)
            if (const auto result = stands_for(defect(kept[i]), bounds[i], values[i], end); !result)
                return result;
    }
    return testing::AssertionSuccess();
}

TEST(RangeCodes, KeepBoundsOutwards) {
    EXPECT_TRUE(keeps_bounds([](float kept) { return kept; }));
    EXPECT_FALSE(keeps_bounds([](float kept) { return std::nextafter(kept, 0.0f); }))
        << static_cast<int>(planted::PageError::narrowed_range);
    EXPECT_FALSE(keeps_bounds([](float kept) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(kept) * 9 / 8);
    })) << "an eighth more floats";
}

TEST(RangeCodes, AreSmall) {
    const std::vector<float> values = {1, 1, 1, -5};
    const std::vector<float> bounds = {1, std::nextafter(1.0f, 0.0f), 0.5f, -infinity};
    const auto codes = page::range_codes(values, bounds, RangeEnd::low);
    EXPECT_EQ(codes[0], 0u);
    EXPECT_EQ(codes[1], 2u);
    for (const std::uint32_t code : codes) EXPECT_LT(code, 512u);
}

}  // namespace
}  // namespace quadrel::page_tests
