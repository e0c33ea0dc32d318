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

std::int64_t place(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::int64_t size = bits & 0x7fffffffu;
    return bits >> 31 != 0 ? -size : size;
}

/// Whether `kept` is a bound in the place of `bound`.
testing::AssertionResult stands_for(float kept, float bound, float value, RangeEnd end) {
    const auto failure = testing::AssertionFailure()
                         << kept << " for " << bound << " beside " << value;
    if (std::isnan(bound) || std::isnan(kept))
        return std::isnan(bound) && std::isnan(kept) ? testing::AssertionSuccess() : failure;
    const std::int64_t base = std::isnan(value) ? 0 : place(value);
    const std::int64_t outwards =
        end == RangeEnd::low ? place(bound) - place(kept) : place(kept) - place(bound);
    const std::int64_t apart = std::abs(place(bound) - base);
    return outwards >= 0 && 8 * outwards <= apart ? testing::AssertionSuccess() : failure;
}

/// Keeps bounds of values of all sizes; `defect` changes what is kept.
template <class Defect>
testing::AssertionResult keeps_bounds(const Defect& defect) {
    test::Random random(11);
    std::vector<float> values = {0, -0.0f, 1, nan_value, nan_value, infinity, -infinity, 3};
    std::vector<float> bounds = {0, 0, nan_value, nan_value, -2, infinity, -infinity, -infinity};
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
}

TEST(RangeCodes, AreSmall) {
    const std::vector<float> values = {1, 1, 1, -5};
    const std::vector<float> bounds = {1, std::nextafter(1.0f, 0.0f), 0.5f, -infinity};
    const auto codes = page::range_codes(values, bounds, RangeEnd::low);
    EXPECT_EQ(codes[0], 0u);
    EXPECT_EQ(codes[1], 1u);
    for (const std::uint32_t code : codes) EXPECT_LT(code, 512u);
}

}  // namespace
}  // namespace quadrel::page_tests
