#include "quadrel/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "film/films.hpp"
#include "film/planted.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Compare = std::function<CompareReport(const Film&, const Film&, const Tolerance&)>;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Every single change to a film must be seen, from both sides.
AssertionResult sees_every_change(const Compare& compare_) {
    const Film film = testing_films::smooth_film(1);
    const std::function<void(Film&)> changes[] = {
        [](Film& f) { f.planes[0].bits[5] += 1; },
        [](Film& f) { f.planes[0].bits[5] -= 1; },
        [](Film& f) { f.planes[2].bits.back() ^= 1; },
        [](Film& f) { f.planes[1].bits[0] = bits(std::numeric_limits<float>::quiet_NaN()); },
        [](Film& f) { f.planes[1].bits[0] = bits(std::numeric_limits<float>::infinity()); },
        [](Film& f) { f.planes.pop_back(); },
        [](Film& f) { f.add("Z", ChannelType::float32); },
        [](Film& f) { f.planes[0].type = ChannelType::uint32; },
        [](Film& f) { f.planes[0].name = "r"; },
        [](Film& f) { f.frame.x1 += 1; },
        [](Film& f) {
            f.window = {1, 0, 17, 9};
        },
    };
    int number = 0;
    for (const auto& change : changes) {
        Film other = film;
        change(other);
        if (compare_(film, other, {}).equal() || compare_(other, film, {}).equal())
            return AssertionFailure() << "change " << number << " overlooked";
        ++number;
    }
    return AssertionSuccess();
}

AssertionResult tells_zeros_apart(const Compare& compare_) {
    Film a = testing_films::smooth_film(1), b = a;
    a.planes[0].bits[0] = bits(0.0f);
    b.planes[0].bits[0] = bits(-0.0f);
    if (compare_(a, b, {}).equal()) return AssertionFailure() << "-0 taken for +0";
    return AssertionSuccess();
}

CompareReport compare_with(FilmError error, Film reference, Film test) {
    if (error == FilmError::compare_reference_only)
        std::erase_if(test.planes,
                      [&](const Plane& p) { return reference.find(p.name) == nullptr; });
    for (Plane& plane : test.planes) {
        const Plane* other = reference.find(plane.name);
        if (other == nullptr || other->bits.size() != plane.bits.size()) continue;
        for (std::size_t i = 0; i < plane.bits.size(); ++i) {
            const float a = other->as_float(i), b = plane.as_float(i);
            const bool pass = (error == FilmError::compare_skips_nan && !(a - b <= 1e30f)) ||
                              (error == FilmError::compare_signed_error && a - b < 0) ||
                              (error == FilmError::compare_zero_signs && a == b);
            if (pass) plane.bits[i] = other->bits[i];
        }
    }
    return compare(reference, test);
}

TEST(Compare, SeesEveryChange) {
    EXPECT_TRUE(sees_every_change(compare));
    EXPECT_TRUE(tells_zeros_apart(compare));
    const auto with = [](FilmError error) {
        return [error](const Film& a, const Film& b, const Tolerance&) {
            return compare_with(error, a, b);
        };
    };
    EXPECT_FALSE(sees_every_change(with(FilmError::compare_skips_nan)));
    EXPECT_FALSE(sees_every_change(with(FilmError::compare_reference_only)));
    EXPECT_FALSE(sees_every_change(with(FilmError::compare_signed_error)));
    EXPECT_FALSE(tells_zeros_apart(with(FilmError::compare_zero_signs)));
}

TEST(Compare, EqualFilmsAreEqualWhateverTheirNanPayloads) {
    Film film = testing_films::random_film(4);
    Film other = testing_films::sorted_by_name(film);
    EXPECT_TRUE(compare(film, other).equal());
    canonicalize(other);
    EXPECT_TRUE(compare(film, other).equal());
}

TEST(Compare, TolerancesAllowWhatTheySayAndNoMore) {
    Film a = testing_films::smooth_film(2), b = a;
    a.planes[0].bits[20] = bits(2.0f);
    b.planes[0].bits[20] = bits(2.25f);
    EXPECT_FALSE(compare(a, b).equal());
    EXPECT_TRUE(compare(a, b, {.abs = 0.25}).equal());
    EXPECT_FALSE(compare(a, b, {.abs = 0.2499}).equal());
    EXPECT_TRUE(compare(a, b, {.rel = 0.125}).equal());
    EXPECT_FALSE(compare(a, b, {.rel = 0.1249}).equal());
    b.planes[0].bits[20] = a.planes[0].bits[20] + 3;
    EXPECT_TRUE(compare(a, b, {.ulp = 3}).equal());
    EXPECT_FALSE(compare(a, b, {.ulp = 2}).equal());
    a.planes[0].bits[20] = bits(-0.0f);
    b.planes[0].bits[20] = bits(0.0f);
    EXPECT_TRUE(compare(a, b, {.ulp = 1}).equal());
}

TEST(Compare, NoToleranceAllowsNanInfinityOrIntegers) {
    const Tolerance generous{1e30, 1e30, 0xffffffffu};
    for (const float value : {NAN, HUGE_VALF, -HUGE_VALF}) {
        Film a = testing_films::smooth_film(3), b = a;
        b.planes[1].bits[7] = bits(value);
        EXPECT_FALSE(compare(a, b, generous).equal());
        EXPECT_FALSE(compare(b, a, generous).equal());
        a.planes[1].bits[7] = bits(-value);
        EXPECT_EQ(compare(a, b, generous).equal(), std::isnan(value));
    }
    Film a = testing_films::smooth_film(3);
    a.add("hit.steps", ChannelType::uint32, 5);
    Film b = a;
    b.planes.back().bits[0] = 6;
    EXPECT_FALSE(compare(a, b, generous).equal());
}

TEST(Compare, ReportsStatisticsAndTheWorstPixel) {
    Film a{{0, 0, 100, 100}, {10, 20, 14, 22}, {}};
    a.add("Z", ChannelType::float32, bits(1.0f));
    Film b = a;
    b.planes[0].bits[b.index(13, 20)] = bits(1.5f);
    b.planes[0].bits[b.index(12, 21)] = bits(-1.0f);
    const ChannelReport report = compare(a, b).channels[0];
    EXPECT_EQ(report.pixels, 8u);
    EXPECT_EQ(report.differing, 2u);
    EXPECT_EQ(report.max_abs, 2.0);
    EXPECT_EQ(report.mean_abs, 2.5 / 8);
    EXPECT_DOUBLE_EQ(report.rms * report.rms, 4.25 / 8);
    EXPECT_EQ(report.max_ulp, 2 * 0x3f800000u);
    EXPECT_EQ(report.worst_x, 12);
    EXPECT_EQ(report.worst_y, 21);
    b.planes[0].bits[b.index(10, 21)] = bits(NAN);
    const ChannelReport with_nan = compare(a, b).channels[0];
    EXPECT_EQ(with_nan.nan_mismatches, 1u);
    EXPECT_EQ(with_nan.worst_x, 10);
    EXPECT_EQ(with_nan.max_abs, 2.0);
    EXPECT_EQ(with_nan.mean_abs, 2.5 / 7);
}

TEST(Compare, ReportsAreReadable) {
    Film a = testing_films::random_film(5), b = a;
    b.planes[0].bits[0] = 0;
    b.planes[1].bits[4] = 0;
    const CompareReport report = compare(a, b);
    const auto json = nlohmann::json::parse(to_json(report));
    EXPECT_EQ(json["equal"], false);
    EXPECT_EQ(json["channels"].size(), a.planes.size());
    EXPECT_EQ(json["channels"][0]["worst"]["reference"], "nan");
    EXPECT_NE(to_text(report).find("NaN on one side: 1"), std::string::npos);
    EXPECT_NE(to_text(compare(a, a)).find("\nequal\n"), std::string::npos);
}

}  // namespace
}  // namespace quadrel
