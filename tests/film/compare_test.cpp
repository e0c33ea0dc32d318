#include "quadrel/compare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
using testing_films::bits;
using Compare = std::function<CompareReport(const Film&, const Film&, const Tolerance&)>;

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
        [](Film& f) { f.planes[0].name = std::string("r"); },
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

CompareReport compare_plainly(const Film& a, const Film& b, const Tolerance& tolerance) {
    return compare(a, b, tolerance);
}

TEST(Compare, SeesEveryChange) {
    EXPECT_TRUE(sees_every_change(compare_plainly));
    EXPECT_TRUE(tells_zeros_apart(compare_plainly));
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
    ASSERT_EQ(report.worst.size(), 2u);
    EXPECT_EQ(report.worst[0].x, 12);
    EXPECT_EQ(report.worst[0].y, 21);
    EXPECT_EQ(report.worst[1].x, 13);
    EXPECT_NEAR(report.psnr, 10 * std::log10(8 / 4.25), 1e-12);
    b.planes[0].bits[b.index(10, 21)] = bits(NAN);
    const ChannelReport with_nan = compare(a, b).channels[0];
    EXPECT_EQ(with_nan.nan_mismatches, 1u);
    EXPECT_EQ(with_nan.worst[0].x, 10);
    EXPECT_EQ(with_nan.max_abs, 2.0);
    EXPECT_EQ(with_nan.mean_abs, 2.5 / 7);
    EXPECT_TRUE(std::isfinite(with_nan.psnr));
    Film lost = a;
    EXPECT_EQ(compare(a, lost).channels[0].psnr, INFINITY);
    lost.planes[0].bits[0] = bits(NAN);
    EXPECT_TRUE(std::isnan(compare(a, lost).channels[0].psnr));
}

/// 13 pixels differ by 1 to 13 steps, in some order; the worst ten come first, largest first.
AssertionResult lists_the_worst_ten(const Compare& compare_) {
    Film a{{0, 0, 20, 1}, {0, 0, 20, 1}, {}};
    a.add("Z", ChannelType::float32, bits(1.0f));
    Film b = a;
    for (int i = 0; i < 13; ++i)
        b.planes[0].bits[static_cast<std::size_t>(i)] =
            bits(1.0f + static_cast<float>((i * 5) % 13 + 1) / 64);
    const std::vector<PixelDifference> worst = compare_(a, b, {}).channels[0].worst;
    if (worst.size() != most_worst_pixels) return AssertionFailure() << worst.size() << " pixels";
    for (std::size_t rank = 0; rank < worst.size(); ++rank) {
        const float expected = 1.0f + static_cast<float>(13 - rank) / 64;
        if (worst[rank].test != bits(expected)) return AssertionFailure() << "rank " << rank;
        if (b.planes[0].bits[b.index(worst[rank].x, worst[rank].y)] != worst[rank].test)
            return AssertionFailure() << "place of rank " << rank;
    }
    return AssertionSuccess();
}

/// Two of 144 pixels are off: a fraction of 2/144 allows them, 1/144 does not, and no fraction
/// allows a NaN.
AssertionResult keeps_to_the_fraction(const Compare& compare_) {
    const Film a = testing_films::smooth_film(6);
    Film b = a;
    b.planes[1].bits[3] = bits(7.0f);
    b.planes[1].bits[4] = bits(std::numeric_limits<float>::infinity());
    const double one = 1.0 / static_cast<double>(a.window.area());
    Tolerance tolerance;
    tolerance.fraction = 2 * one;
    if (!compare_(a, b, tolerance).equal()) return AssertionFailure() << "2 of 2 not allowed";
    tolerance.fraction = one;
    if (compare_(a, b, tolerance).equal()) return AssertionFailure() << "2 of 1 allowed";
    tolerance.fraction = 1;
    b.planes[1].bits[4] = bits(NAN);
    if (compare_(a, b, tolerance).equal()) return AssertionFailure() << "NaN allowed";
    return AssertionSuccess();
}

CompareReport compare_loosely(FilmError error, const Film& a, const Film& b, Tolerance tolerance) {
    if (error == FilmError::compare_any_fraction && tolerance.fraction > 0) tolerance.fraction = 1;
    CompareReport report = compare(a, b, tolerance);
    for (ChannelReport& channel : report.channels) {
        if (error == FilmError::compare_fraction_nan) channel.nan_mismatches = 0;
        if (error == FilmError::compare_worst_first)
            std::sort(channel.worst.begin(), channel.worst.end(),
                      [](const auto& p, const auto& q) { return p.x < q.x; });
    }
    return report;
}

TEST(Compare, WorstPixelsAndFractions) {
    EXPECT_TRUE(lists_the_worst_ten(compare_plainly));
    EXPECT_TRUE(keeps_to_the_fraction(compare_plainly));
    const auto with = [](FilmError error) {
        return [error](const Film& a, const Film& b, const Tolerance& tolerance) {
            return compare_loosely(error, a, b, tolerance);
        };
    };
    EXPECT_FALSE(lists_the_worst_ten(with(FilmError::compare_worst_first)));
    EXPECT_FALSE(keeps_to_the_fraction(with(FilmError::compare_fraction_nan)));
    EXPECT_FALSE(keeps_to_the_fraction(with(FilmError::compare_any_fraction)));
}

using CompareByRules = std::function<CompareReport(const Film&, const Film&, const CompareRules&)>;

/// A tolerance for R lets R pass and nothing else.
AssertionResult keeps_tolerances_to_their_channels(const CompareByRules& compare_) {
    const Film a = testing_films::smooth_film(7);
    for (const std::size_t channel : {0u, 1u}) {
        Film b = a;
        b.planes[channel].bits[9] = bits(a.planes[channel].as_float(9) + 0.125f);
        CompareRules rules;
        rules.channels["R"].abs = 0.25;
        if (compare_(a, b, rules).equal() != (channel == 0))
            return AssertionFailure() << a.planes[channel].name;
    }
    return AssertionSuccess();
}

TEST(Compare, TolerancesByChannel) {
    const auto by_rules = [](const Film& a, const Film& b, const CompareRules& rules) {
        return compare(a, b, rules);
    };
    EXPECT_TRUE(keeps_tolerances_to_their_channels(by_rules));
    EXPECT_FALSE(keeps_tolerances_to_their_channels(
        [](const Film& a, const Film& b, CompareRules rules) {  // compare_group_is_all
            rules.all = rules.channels.begin()->second;
            return compare(a, b, rules);
        }));
    CompareRules rules;
    rules.all.abs = 5;
    EXPECT_EQ(rules.tolerance_of("id.object", ChannelType::uint32).abs, 0);
    rules.channels["hit.steps"].abs = 2;
    Film a = testing_films::smooth_film(3);
    a.add("hit.steps", ChannelType::uint32, 5);
    Film b = a;
    b.planes.back().bits[0] = 7;
    EXPECT_TRUE(compare(a, b, rules).equal());
    b.planes.back().bits[0] = 8;
    EXPECT_FALSE(compare(a, b, rules).equal());
}

TEST(Compare, ReportsAreReadable) {
    Film a = testing_films::random_film(5), b = a;
    b.planes[0].bits[0] = 0;
    b.planes[1].bits[4] = 0;
    const CompareReport report = compare(a, b);
    const auto json = nlohmann::json::parse(to_json(report));
    EXPECT_EQ(json["equal"], false);
    EXPECT_EQ(json["channels"].size(), a.planes.size());
    EXPECT_EQ(json["channels"][0]["worst"][0]["reference"], "nan");
    EXPECT_NE(to_text(report).find("NaN on one side: 1"), std::string::npos);
    EXPECT_NE(to_text(compare(a, a)).find("\nequal\n"), std::string::npos);
}

}  // namespace
}  // namespace quadrel
