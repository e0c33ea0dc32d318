// The distance of floats, and encodings against loops over all codes.
#include "quadrel/film/encoding.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "film/planted.hpp"
#include "quadrel/num/half.hpp"
#include "quadrel/num/srgb.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Distance = std::function<std::uint32_t(float, float)>;
using Encode = std::function<float(Encoding, float)>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();
constexpr float tiny = std::numeric_limits<float>::denorm_min();
constexpr float smallest_normal = std::numeric_limits<float>::min();
const float nan_value = std::numeric_limits<float>::quiet_NaN();

struct Apart {
    float a, b;
    std::uint32_t distance;
};

AssertionResult knows_the_distances(const Distance& distance) {
    const Apart cases[] = {
        {1, 1, 0},
        {1, std::nextafter(1.0f, 2.0f), 1},
        {-1, std::nextafter(-1.0f, -2.0f), 1},
        {0.0f, -0.0f, 0},
        {0, tiny, 1},
        {-0.0f, tiny, 1},
        {-tiny, tiny, 2},
        {3 * tiny, 7 * tiny, 4},
        {smallest_normal, smallest_normal - tiny, 1},
        {0, smallest_normal, 0x00800000},
        {1, -1, 2 * 0x3f800000u},
        {1, 2, 0x00800000},
        {largest, infinity, 1},
        {-largest, -infinity, 1},
        {infinity, infinity, 0},
        {-infinity, infinity, 0xff000000u},
        {nan_value, nan_value, 0},
        {nan_value, -nan_value, 0},
        {nan_value, 1, no_distance},
        {nan_value, infinity, no_distance},
        {nan_value, 0, no_distance},
    };
    for (const Apart& one : cases)
        for (const bool swapped : {false, true}) {
            const float a = swapped ? one.b : one.a, b = swapped ? one.a : one.b;
            if (distance(a, b) != one.distance)
                return AssertionFailure() << a << " and " << b << ": " << distance(a, b)
                                          << " instead of " << one.distance;
        }
    return AssertionSuccess();
}

std::uint32_t flawed_distance(FilmError error, float a, float b) {
    const auto bits_a = std::bit_cast<std::uint32_t>(a), bits_b = std::bit_cast<std::uint32_t>(b);
    const auto flush = [](float x) { return std::abs(x) < smallest_normal ? 0.0f : x; };
    switch (error) {
        case FilmError::ulp_raw_bits:
            return bits_a > bits_b ? bits_a - bits_b : bits_b - bits_a;
        case FilmError::ulp_flush_denormals:
            return ulp_distance(flush(a), flush(b));
        case FilmError::ulp_of_absolute_values:
            return ulp_distance(std::abs(a), std::abs(b));
        case FilmError::ulp_saturating_int:
            return std::isnan(a) || std::isnan(b) ? ulp_distance(a, b)
                                                  : std::min(ulp_distance(a, b), 0x7fffffffu);
        case FilmError::ulp_nan_is_zero:
            return std::isnan(a) || std::isnan(b) ? 0 : ulp_distance(a, b);
        case FilmError::ulp_zero_signs:
            return ulp_distance(a, b) + (std::signbit(a) != std::signbit(b) ? 1 : 0);
        default:
            return ulp_distance(a, b);
    }
}

TEST(UlpDistance, ZeroDenormalsInfinitiesAndNan) {
    EXPECT_TRUE(knows_the_distances([](float a, float b) { return ulp_distance(a, b); }));
    for (const FilmError error : {FilmError::ulp_raw_bits, FilmError::ulp_flush_denormals,
                                  FilmError::ulp_of_absolute_values, FilmError::ulp_saturating_int,
                                  FilmError::ulp_nan_is_zero, FilmError::ulp_zero_signs})
        EXPECT_FALSE(knows_the_distances([error](float a, float b) {
            return flawed_distance(error, a, b);
        })) << static_cast<int>(error);
}

TEST(UlpDistance, CountsCodesAndHalves) {
    EXPECT_EQ(ulp_distance(Encoding::srgb8, 10 / 255.0f, 13 / 255.0f), 3u);
    EXPECT_EQ(ulp_distance(Encoding::unorm8, 1.0f, 0.0f), 255u);
    EXPECT_EQ(ulp_distance(Encoding::half, 1.0f, 1.0f + 0x1p-10f), 1u);
    EXPECT_EQ(ulp_distance(Encoding::half, -0x1p-24f, 0x1p-24f), 2u);
    EXPECT_EQ(ulp_distance(Encoding::half, nan_value, 1.0f), no_distance);
}

/// Every code comes back from its own value, and between two codes the change is half-way.
AssertionResult rounds_to_the_nearest_code(const Encode& encode_) {
    for (int code = 0; code <= 255; ++code) {
        const double c = code / 255.0;
        if (code_of(encode_(Encoding::unorm8, static_cast<float>(c))) != code ||
            code_of(encode_(Encoding::srgb8, static_cast<float>(srgb_decode(c)))) != code)
            return AssertionFailure() << "code " << code << " is not its own";
        for (const double step : {0.499, 0.501}) {
            const int expected = std::min(step < 0.5 ? code : code + 1, 255);
            const double between = (code + step) / 255;
            if (code_of(encode_(Encoding::unorm8, static_cast<float>(between))) != expected ||
                code_of(encode_(Encoding::srgb8, static_cast<float>(srgb_decode(between)))) !=
                    expected)
                return AssertionFailure() << "after code " << code << " + " << step;
        }
    }
    return AssertionSuccess();
}

AssertionResult treats_special_values(const Encode& encode_) {
    for (const Encoding encoding : {Encoding::unorm8, Encoding::srgb8}) {
        const Apart cases[] = {{-1, 0, 0},   {-0.0f, 0, 0},     {2, 1, 0}, {infinity, 1, 0},
                               {tiny, 0, 0}, {-infinity, 0, 0}, {1, 1, 0}};
        for (const auto& [value, expected, unused] : cases)
            if (encode_(encoding, value) != expected) return AssertionFailure() << value;
        if (!std::isnan(encode_(encoding, nan_value))) return AssertionFailure() << "NaN";
    }
    if (code_of(encode_(Encoding::unorm8, 0.5f)) != 128) return AssertionFailure() << "the tie";
    return AssertionSuccess();
}

/// All 63488 halves but the NaNs are fixed; half-way values go to the even one, others to the near.
AssertionResult rounds_to_the_nearest_half(const Encode& encode_) {
    for (unsigned half = 0; half < 0x7c00; ++half) {
        const float here = half_to_float(static_cast<std::uint16_t>(half));
        const float next =
            half == 0x7bff ? 65536.0f : half_to_float(static_cast<std::uint16_t>(half + 1));
        const float above = half == 0x7bff ? infinity : next;
        const float middle = here + (next - here) / 2;
        if (encode_(Encoding::half, here) != here || encode_(Encoding::half, -here) != -here ||
            encode_(Encoding::half, middle) != (half % 2 == 0 ? here : above) ||
            encode_(Encoding::half, std::nextafter(middle, 0.0f)) != here ||
            encode_(Encoding::half, std::nextafter(middle, infinity)) != above)
            return AssertionFailure() << "half " << half;
    }
    return AssertionSuccess();
}

float flawed_encode(FilmError error, Encoding encoding, float value) {
    const float clamped = std::min(std::max(value, 0.0f), 1.0f);
    switch (error) {
        case FilmError::encode_truncates:
            return encoding == Encoding::unorm8 ? std::floor(clamped * 255) / 255
                                                : encode(encoding, value);
        case FilmError::encode_gamma_22:
            return encoding == Encoding::srgb8 ? encode(Encoding::unorm8, pow(clamped, 1 / 2.2f))
                                               : encode(encoding, value);
        case FilmError::encode_nan_is_zero:
            return std::isnan(value) ? 0 : encode(encoding, value);
        case FilmError::encode_half_truncates:
            return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & 0xffffe000u);
        default:
            return encode(encoding, value);
    }
}

TEST(Encoding, RoundsToTheNearest) {
    EXPECT_TRUE(rounds_to_the_nearest_code(encode));
    EXPECT_TRUE(rounds_to_the_nearest_half(encode));
    EXPECT_TRUE(treats_special_values(encode));
    const auto with = [](FilmError error) {
        return [error](Encoding e, float value) { return flawed_encode(error, e, value); };
    };
    EXPECT_FALSE(rounds_to_the_nearest_code(with(FilmError::encode_truncates)));
    EXPECT_FALSE(rounds_to_the_nearest_code(with(FilmError::encode_gamma_22)));
    EXPECT_FALSE(treats_special_values(with(FilmError::encode_nan_is_zero)));
    EXPECT_FALSE(rounds_to_the_nearest_half(with(FilmError::encode_half_truncates)));
}

TEST(Encoding, NamesAreReadBack) {
    for (const Encoding encoding :
         {Encoding::none, Encoding::half, Encoding::unorm8, Encoding::srgb8})
        EXPECT_EQ(parse_encoding(encoding_name(encoding)), encoding);
    EXPECT_EQ(parse_encoding("sRGB"), std::nullopt);
}

}  // namespace
}  // namespace quadrel
