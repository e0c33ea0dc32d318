// Runs of quads as rows of pixels: the bits of their lanes, one by one.
#include "render/draw/lane_bits.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <vector>

#include "quadrel/film/resolve.hpp"

namespace quadrel::render_tests {
namespace {

using Element = LaneBits::Element;
using PackRows = std::function<void(const LaneBits&, int first, int quads, std::uint32_t* even,
                                    std::uint32_t* odd)>;

void real_rows(const LaneBits& bits, int first, int quads, std::uint32_t* even,
               std::uint32_t* odd) {
    bits.rows(first, quads, even, odd);
}

constexpr int batch_lanes = 256;

/// Numbers of all kinds: NaNs of both signs and of other payloads, infinities, zeros of both signs.
std::uint32_t pattern(int i) {
    const std::uint32_t odd[] = {0x7fc00000u, 0xffc00000u, 0x7f800001u, 0xff812345u, 0x7f800000u,
                                 0xff800000u, 0x00000000u, 0x80000000u, 0x00000001u, 0x7f7fffffu};
    return i % 3 == 0 ? odd[i / 3 % 10] : 0x9e3779b9u * static_cast<std::uint32_t>(i + 1);
}

testing::AssertionResult same_as_lanes(const PackRows& rows) {
    std::vector<std::uint32_t> words(batch_lanes);
    std::vector<double> wide(batch_lanes);
    for (int i = 0; i < batch_lanes; ++i) {
        words[std::size_t(i)] = pattern(i);
        wide[std::size_t(i)] = i % 5 == 0 ? 1.0 / (i + 3) : std::bit_cast<float>(pattern(i));
    }
    const LaneBits arrays[] = {{words.data(), Element::integer},
                               {words.data(), Element::single},
                               {words.data(), Element::single, true},
                               {wide.data(), Element::wide},
                               {wide.data(), Element::wide, true},
                               LaneBits(words.data(), Element::single).resolved(4),
                               LaneBits(wide.data(), Element::wide).resolved(16)};
    constexpr std::uint32_t untouched = 0xabcdef01u;
    for (std::size_t a = 0; a < std::size(arrays); ++a)
        for (const int first : {0, 4, 92})
            for (const int quads : {1, 2, 3, 7, 32, 41}) {
                std::vector<std::uint32_t> even(std::size_t(2 * quads + 1), untouched), odd = even;
                rows(arrays[a], first, quads, even.data(), odd.data());
                if (even.back() != untouched || odd.back() != untouched)
                    return testing::AssertionFailure() << "beyond the row";
                for (int i = 0; i < 4 * quads; ++i) {
                    const auto& row = i % 4 < 2 ? even : odd;
                    const std::uint32_t found = row[std::size_t(2 * (i / 4) + i % 2)];
                    if (found != arrays[a](first + i))
                        return testing::AssertionFailure()
                               << "array " << a << ", lane " << first + i << ": " << std::hex
                               << found << ", expected " << arrays[a](first + i);
                }
            }
    return testing::AssertionSuccess();
}

TEST(LaneBits, RowsHaveTheBitsOfTheirLanes) { EXPECT_TRUE(same_as_lanes(real_rows)); }

using Resolved = std::function<std::uint32_t(const LaneBits&, int samples, int lane)>;

/// A pixel of which one fragment has all samples, against resolving them.
testing::AssertionResult same_as_resolving(const Resolved& resolved) {
    std::vector<std::uint32_t> words(batch_lanes);
    for (int i = 0; i < batch_lanes; ++i) words[std::size_t(i)] = pattern(i);
    for (const int samples : {1, 2, 4, 8, 16})
        for (int i = 0; i < batch_lanes; ++i) {
            const ColorSample sample{std::bit_cast<float>(pattern(i)), 0, 0, 1, 0};
            const ColorSample pixel =
                resolve(std::vector<ColorSample>(static_cast<std::size_t>(samples), sample));
            const std::uint32_t expected = canonical_bits(std::bit_cast<std::uint32_t>(pixel.r));
            if (resolved({words.data(), Element::single}, samples, i) != expected || pixel.a != 1)
                return testing::AssertionFailure() << samples << " samples, lane " << i;
        }
    return testing::AssertionSuccess();
}

TEST(LaneBits, ResolveEqualSamples) {
    EXPECT_TRUE(same_as_resolving(
        [](const LaneBits& bits, int samples, int lane) { return bits.resolved(samples)(lane); }));
    EXPECT_FALSE(same_as_resolving([](const LaneBits& bits, int, int lane) { return bits(lane); }))
        << "sums that overflow";
}

TEST(LaneBits, ErrorsAreNoticed) {
    EXPECT_FALSE(same_as_lanes([](const LaneBits& bits, int first, int quads, auto* even,
                                  auto* odd) { bits.rows(first, quads, odd, even); }));
    EXPECT_FALSE(
        same_as_lanes([](const LaneBits& bits, int first, int quads, auto* even, auto* odd) {
            bits.rows(first, quads, even, odd);
            for (int i = 0; i < 2 * quads; ++i)
                if (even[i] == canonical_nan) even[i] |= 1;
        }));
    EXPECT_FALSE(
        same_as_lanes([](const LaneBits& bits, int first, int quads, auto* even, auto* odd) {
            for (int q = 0; q < quads; ++q) bits.rows(first, 1, even + 2 * q, odd + 2 * q);
        }));
    EXPECT_FALSE(same_as_lanes([](const LaneBits& bits, int first, int quads, auto* even,
                                  auto* odd) { bits.rows(first, quads / 2 * 2, even, odd); }));
}

}  // namespace
}  // namespace quadrel::render_tests
