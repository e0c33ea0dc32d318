// Judging an image by the ranges that its reference holds.
#include "quadrel/film/legal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/presence.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::bits;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// ---- One value ----------------------------------------------------------------------------------

using Judge = std::function<LegalVerdict(const LegalRange&, double)>;

/// A case of a channel whose extent is 10, where what is wider than 1 is wide.
struct Case {
    LegalRange range;
    float value;
    LegalVerdict expected;
};

const std::vector<Case>& cases() {
    using enum LegalVerdict;
    static const std::vector<Case> all = {
        {{1, 2, 1}, 1.5f, pass},
        {{1, 2, 1}, 1, pass},
        {{1, 2, 1}, 2, pass},
        {{3, 3, 1}, 3, pass},
        {{-0.0f, 0.0f, 1}, -0.0f, pass},
        {{0.0f, 0.0f, 1}, -0.0f, pass},
        {{infinite, infinite, 1}, infinite, pass},
        {{-infinite, -infinite, 1}, -infinite, pass},
        {{nan, nan, 1}, nan, pass},
        {{1, 2, 2}, 1.5f, ambiguous},
        {{1, 2, 64}, 2, ambiguous},
        {{1, 2.25f, 1}, 1.5f, unconstrained},
        {{1, 2.25f, 3}, 1.5f, unconstrained},
        {{-infinite, infinite, 1}, 0, unconstrained},
        {{1, infinite, 1}, infinite, unconstrained},
        {{1, infinite, 2}, 5, unconstrained},
        {{1, nan, 1}, 7, unconstrained},
        {{1, nan, 1}, nan, unconstrained},
        {{nan, 1, 2}, -7, unconstrained},
        {{1, 2, 0}, 1.5f, unconstrained},
        {{1, 2, 0}, 9, unconstrained},
        {{1, 2, 0}, nan, unconstrained},
        {{2, 1, 0}, nan, unconstrained},
        {{1, 9, 2, 1.5f, 8.75f}, 1.25f, ambiguous},
        {{1, 9, 2, 1.5f, 8.75f}, 1.5f, ambiguous},
        {{1, 9, 2, 1.5f, 8.75f}, 8.75f, ambiguous},
        {{1, 9, 2, 1.5f, 8.75f}, 3, fail},
        {{1, 9, 2, 1.5f, 8.75f}, 9.5f, fail},
        {{1, 9, 2, 2, 8.5f}, 9, unconstrained},
        {{1, 9, 2, 2, 8.5f}, 3, fail},
        {{1, 9, 2, 8.75f, 1.5f}, 3, unconstrained},
        {{1, 9, 2, 0, 8.75f}, 3, unconstrained},
        {{1, 9, 2, 1.5f, 9.25f}, 3, unconstrained},
        {{1, 9, 2, nan, nan}, 3, unconstrained},
        {{1, 9, 0, 1.5f, 8.75f}, 3, unconstrained},
        {{1, infinite, 2, 1.5f, 8.75f}, 3, fail},
        {{1, 2, 1}, 2.001f, fail},
        {{1, 2, 1}, 0.999f, fail},
        {{1, 2, 5}, 2.001f, fail},
        {{1, 2, 1}, nan, fail},
        {{-infinite, infinite, 1}, nan, fail},
        {{1, infinite, 1}, 0, fail},
        {{1, 8, 1}, 9, fail},
        {{1, nan, 1}, 0, fail},
        {{nan, 1, 1}, 2, fail},
        {{nan, nan, 1}, 0, fail},
        {{nan, nan, 1}, infinite, fail},
        {{2, 1, 1}, 1.5f, fail},
        {{infinite, -infinite, 1}, 0, fail},
        {{3, 3, 1}, std::nextafter(3.0f, 4.0f), fail},
        {{infinite, infinite, 1}, std::numeric_limits<float>::max(), fail},
    };
    return all;
}

AssertionResult judges_each_case(const Judge& judge_) {
    for (const Case& one : cases())
        if (const LegalVerdict verdict = judge_(one.range, one.value); verdict != one.expected)
            return AssertionFailure()
                   << one.value << " in " << one.range.lo << " to " << one.range.hi << ", "
                   << one.range.paths << " ranges: " << legal_verdict_name(verdict);
    return AssertionSuccess();
}

LegalVerdict verdict(const LegalRange& range, double value) {
    return legal_verdict(range, value, 10, 0.1);
}

/// legal_verdict with an error in it.
Judge planted_judge(FilmError error) {
    return [error](const LegalRange& range, double value) {
        using enum LegalVerdict;
        const LegalVerdict right = verdict(range, value);
        const bool outside = value < range.lo || value > range.hi;
        switch (error) {
            case FilmError::legal_nan_passes:
                return right == fail && std::isnan(value) ? pass : right;
            case FilmError::legal_ends_excluded:
                return value <= range.lo || value >= range.hi ? fail : right;
            case FilmError::legal_unknown_fails:
                return outside ? fail : right;
            case FilmError::legal_wide_passes:
                return right == unconstrained && range.paths > 0 ? pass : right;
            case FilmError::legal_wide_excuses:
                return double{range.hi} - double{range.lo} > 1 ? unconstrained : right;
            case FilmError::legal_gaps_pass:
                return right == ambiguous ? pass : right;
            case FilmError::legal_gap_forgotten:
                return verdict({range.lo, range.hi, range.paths}, value);
            default:
                return right;
        }
    };
}

TEST(Legal, TheVerdictOnAValue) {
    EXPECT_TRUE(judges_each_case(verdict));
    for (const FilmError error : {FilmError::legal_nan_passes, FilmError::legal_ends_excluded,
                                  FilmError::legal_unknown_fails, FilmError::legal_wide_passes,
                                  FilmError::legal_wide_excuses, FilmError::legal_gaps_pass,
                                  FilmError::legal_gap_forgotten})
        EXPECT_FALSE(judges_each_case(planted_judge(error))) << static_cast<int>(error);
}

// ---- An image -----------------------------------------------------------------------------------

/// A film with R between 0 and 1, and a range of +-0.01 about each value.
Film reference_film(const Window& window = {2, 1, 12, 9}) {
    std::mt19937 random(7);
    Film film{{0, 0, 16, 10}, window, {}};
    for (const char* name : {"R", "gpu.lo.R", "gpu.hi.R"}) film.add(name, ChannelType::float32);
    film.add("gpu.paths.R", ChannelType::uint32, 1);
    for (std::size_t i = 0; i < window.area(); ++i) {
        const float value = static_cast<float>(random() % 1000) / 1000;
        film.find("R")->bits[i] = bits(value);
        film.find("gpu.lo.R")->bits[i] = bits(value - 0.01f);
        film.find("gpu.hi.R")->bits[i] = bits(value + 0.01f);
    }
    return film;
}

Film test_film(const Film& reference) {
    Film film{reference.frame, reference.window, {}};
    film.planes.push_back(*reference.find("R"));
    return film;
}

LegalReport judge_films(const Film& reference, const Film& test, const LegalRules& rules = {}) {
    return judge(take_apart(reference, "ref.exr"), test, rules);
}

void move_pixel(Film& test, int x, int y, float by) {
    Plane& plane = test.planes[0];
    const std::size_t i = test.index(x, y);
    plane.bits[i] = bits(plane.as_float(i) + by);
}

TEST(Legal, TheReferenceItselfIsLegal) {
    const Film reference = reference_film();
    const LegalReport report = judge_films(reference, test_film(reference));
    EXPECT_TRUE(report.passes());
    ASSERT_EQ(report.channels.size(), 1u);
    EXPECT_EQ(report.channels[0].count(LegalVerdict::pass), 80u);
    EXPECT_EQ(report.channels[0].reference_outside, 0u);
}

using FindWorst = std::function<std::vector<LegalPixel>(const Film&, const Film&)>;

AssertionResult names_the_worst(const FindWorst& find) {
    const Film reference = reference_film();
    Film test = test_film(reference);
    for (int x = 2; x < 12; ++x) move_pixel(test, x, 1, 0.02f);
    move_pixel(test, 5, 8, -0.5f);
    move_pixel(test, 4, 8, 0.25f);
    test.planes[0].bits[test.index(11, 8)] = canonical_nan;
    const std::vector<LegalPixel> worst = find(reference, test);
    const std::pair<int, int> expected[] = {{11, 8}, {5, 8}, {4, 8}};
    if (worst.size() != most_worst_pixels) return AssertionFailure() << worst.size();
    for (std::size_t i = 0; i < std::size(expected); ++i)
        if (std::pair(worst[i].x, worst[i].y) != expected[i])
            return AssertionFailure() << worst[i].x << "," << worst[i].y;
    return AssertionSuccess();
}

TEST(Legal, NamesTheWorstPixelsWithTheirRanges) {
    const FindWorst right = [](const Film& reference, const Film& test) {
        return judge_films(reference, test).channels[0].worst;
    };
    EXPECT_TRUE(names_the_worst(right));
    EXPECT_FALSE(names_the_worst([](const Film& reference, const Film& test) {
        std::vector<LegalPixel> found;  // legal_first_ten
        for (int x = 2; x < 12; ++x) found.push_back({x, 1, 0, {}, {}});
        return judge_films(reference, test).passes() ? std::vector<LegalPixel>{} : found;
    }));
    const Film reference = reference_film();
    Film test = test_film(reference);
    move_pixel(test, 5, 8, -0.5f);
    const std::string text = to_text(judge_films(reference, test));
    const std::size_t i = reference.index(5, 8);
    EXPECT_NE(text.find("worst at 5,8: test "), std::string::npos) << text;
    EXPECT_NE(
        text.find(", permitted " + nlohmann::json(reference.find("gpu.lo.R")->as_float(i)).dump()),
        std::string::npos)
        << text;
    EXPECT_TRUE(text.ends_with("not legal\n"));
}

using JudgeFilms = std::function<LegalReport(const Film&, const Film&)>;

/// Pixels are matched by where they are in the frame; what the test lacks fails.
AssertionResult finds_missing_pixels(const JudgeFilms& judge_) {
    const Film reference = reference_film();
    Film test = test_film(reference_film({2, 1, 12, 9}));
    crop(test, {4, 3, 12, 9});
    const LegalReport report = judge_(reference, test);
    const auto& channel = report.channels.at(0);
    if (channel.missing != 80 - 48) return AssertionFailure() << channel.missing << " are missing";
    if (channel.count(LegalVerdict::fail) != channel.missing)
        return AssertionFailure() << "pixels fail that are there";
    return report.passes() ? AssertionFailure() << "passes" : AssertionSuccess();
}

TEST(Legal, MissingPixelsFail) {
    const JudgeFilms right = [](const Film& a, const Film& b) { return judge_films(a, b); };
    EXPECT_TRUE(finds_missing_pixels(right));
    EXPECT_FALSE(finds_missing_pixels([](const Film& a, Film b) {  // legal_window_shifted
        b.window = {a.window.x0, a.window.y0, a.window.x0 + 8, a.window.y0 + 6};
        return judge_films(a, b);
    }));
    Film larger = test_film(reference_film());
    larger.frame = {0, 0, 17, 10};
    const LegalReport report = judge_films(reference_film(), larger);
    EXPECT_FALSE(report.passes());
    EXPECT_EQ(report.structure.size(), 1u);
}

// ---- Coverage -----------------------------------------------------------------------------------

/// Covered but for the last two columns of ten; next to these it is undecided what is.
Film partly_covered() {
    Film film = reference_film();
    film.add("A", ChannelType::float32);
    film.add("undecided", ChannelType::uint32, 2);
    for (int y = 1; y < 9; ++y)
        for (int x = 2; x < 12; ++x) {
            const std::size_t i = film.index(x, y);
            film.find("A")->bits[i] = bits(x < 10 ? 1.0f : 0.0f);
            if (x == 9 || x == 10) film.find("undecided")->bits[i] |= undecided_presence;
        }
    return film;
}

/// `drawn` without a fragment at a pixel, or with one that lies in its range.
void change_coverage(Film& drawn, int x, int y, bool covered) {
    const std::size_t i = drawn.index(x, y);
    drawn.find("A")->bits[i] = bits(covered ? 1.0f : 0.0f);
    if (!covered) drawn.find("R")->bits[i] = bits(-7);
}

/// What is missing or too much beside an edge is ambiguous, in the interior it fails, even where
/// the value lies in its range; `judge_` may forget that.
AssertionResult judges_coverage(const JudgeFilms& judge_) {
    const Film reference = partly_covered();
    const auto judged = [&](int x, bool covered) {
        Film test = reference;
        std::erase_if(test.planes, [](const Plane& plane) { return plane.name.size() > 1; });
        change_coverage(test, x, 4, covered);
        return judge_(reference, test);
    };
    for (const auto& [x, covered] : {std::pair{9, false}, {10, true}}) {
        const LegalReport report = judged(x, covered);
        if (!report.passes() || report.channels.at(0).count(LegalVerdict::ambiguous) != 1 ||
            report.alone_undecided != 1)
            return AssertionFailure() << "undecided at " << x << ": " << to_text(report);
    }
    for (const auto& [x, covered] : {std::pair{5, false}, {11, true}}) {
        const LegalReport report = judged(x, covered);
        if (report.passes() || report.channels.at(0).count(LegalVerdict::fail) != 1 ||
            report.alone_decided != 1 ||
            to_text(report).find("one side alone covers the pixel") == std::string::npos)
            return AssertionFailure() << "decided at " << x << ": " << to_text(report);
    }
    return AssertionSuccess();
}

TEST(Legal, CoverageIsAmbiguousWhereItIsUndecidedAlone) {
    const JudgeFilms right = [](const Film& a, const Film& b) { return judge_films(a, b); };
    EXPECT_TRUE(judges_coverage(right));
    EXPECT_FALSE(judges_coverage([&](Film a, const Film& b) {  // whatever is undecided excuses
        for (std::uint32_t& undecided : a.find("undecided")->bits) undecided |= undecided_presence;
        return right(a, b);
    }));
    EXPECT_FALSE(judges_coverage([&](Film a, const Film& b) {  // nothing excuses
        for (std::uint32_t& undecided : a.find("undecided")->bits) undecided &= ~undecided_presence;
        return right(a, b);
    }));
    EXPECT_FALSE(judges_coverage([&](Film a, const Film& b) {  // values alone are judged
        std::erase_if(a.planes, [](const Plane& plane) { return plane.name == "undecided"; });
        return right(a, b);
    }));
    // Where a side has no A nothing is said of coverage, and that is.
    const Film reference = partly_covered();
    const LegalReport blind = right(reference, test_film(reference));
    EXPECT_TRUE(blind.passes());
    ASSERT_EQ(blind.notes.size(), 1u);
    EXPECT_EQ(blind.notes[0], "coverage is not judged: the test image lacks A");
}

TEST(Legal, SharesHaveLimits) {
    Film reference = reference_film();
    const Film test = test_film(reference);
    std::vector<std::uint32_t>& paths = reference.find("gpu.paths.R")->bits;
    std::fill_n(paths.begin(), 4, 2);  // 5 % of 80
    EXPECT_TRUE(judge_films(reference, test).passes());
    paths[4] = 2;
    EXPECT_FALSE(judge_films(reference, test).passes());
    EXPECT_TRUE(judge_films(reference, test, {0.1, 0.0625, 0, {}}).passes());
    EXPECT_FALSE(judge_films(reference, test, {0.1, 0.0624, 1, {}}).passes());
    std::fill_n(paths.begin(), 5, 1);
    paths[9] = 0;
    EXPECT_FALSE(judge_films(reference, test).passes());
    EXPECT_TRUE(judge_films(reference, test, {0.1, 0, 0.0125, {}}).passes());
    LegalRules rules;
    rules.left_out.assign(80, false);
    rules.left_out[9] = true;
    const LegalReport report = judge_films(reference, test, rules);
    EXPECT_TRUE(report.passes());
    EXPECT_EQ(report.channels[0].pixels, 79u);
    EXPECT_EQ(report.left_out, 1u);
}

TEST(Legal, WideIsAPartOfTheChannelsExtent) {
    const Film reference = reference_film();
    const Film test = test_film(reference);
    EXPECT_NEAR(judge_films(reference, test).channels[0].extent, 1, 0.05);
    EXPECT_TRUE(judge_films(reference, test, {0.03, 0, 0, {}}).passes());
    EXPECT_FALSE(judge_films(reference, test, {0.015, 1, 0.99, {}}).passes());
}

/// A component that is 0 everywhere is judged by the size of its vector; a single value by itself,
/// and if it is 0 by roundings.
TEST(Legal, AConstantChannelHasAnExtent) {
    Film reference{{0, 0, 2, 1}, {0, 0, 2, 1}, {}};
    for (const char* name : {"N.X", "N.Z", "hit.s", "hit.h"})
        for (const char* prefix : {"", "gpu.lo.", "gpu.hi."})
            reference.add(
                prefix + std::string(name), ChannelType::float32,
                bits(std::string(name) == "N.Z" || std::string(name) == "hit.h" ? 2.0f : 0.0f));
    for (const char* name : {"N.X", "N.Z", "hit.s", "hit.h"})
        reference.add("gpu.paths." + std::string(name), ChannelType::uint32, 1);
    Film test = reference;
    const LegalReport report = judge_films(reference, test);
    EXPECT_TRUE(report.passes()) << to_text(report);
    const std::map<std::string, double> expected = {
        {"N.X", 0.2}, {"N.Z", 0.2}, {"hit.s", 10 * 0x1p-20}, {"hit.h", 0.2}};
    for (const LegalChannelReport& channel : report.channels)
        EXPECT_DOUBLE_EQ(channel.extent, expected.at(channel.name)) << channel.name;
    const auto unconstrained = [&](const std::string& name, float width) {
        Film wide = reference;
        for (std::uint32_t& of : wide.find("gpu.hi." + name)->bits)
            of = bits(std::bit_cast<float>(of) + width);
        std::uint64_t count = 0;
        for (const LegalChannelReport& channel : judge_films(wide, test).channels)
            count += channel.count(LegalVerdict::unconstrained);
        return count == 2;
    };
    EXPECT_FALSE(unconstrained("N.X", 0.0199f));
    EXPECT_TRUE(unconstrained("N.X", 0.0201f));
    EXPECT_FALSE(unconstrained("hit.s", 0x1p-21f));
    EXPECT_TRUE(unconstrained("hit.s", 0x1p-19f));
}

TEST(Legal, IntegersAreJudgedByValue) {
    Film reference{{0, 0, 3, 1}, {0, 0, 3, 1}, {}};
    reference.add("hit.steps", ChannelType::uint32).bits = {100, 16777217, 0};
    reference.add("gpu.lo.hit.steps", ChannelType::float32).bits = {bits(99), bits(16777216),
                                                                    bits(0)};
    reference.add("gpu.hi.hit.steps", ChannelType::float32).bits = {bits(101), bits(16777218),
                                                                    bits(0)};
    reference.add("gpu.paths.hit.steps", ChannelType::uint32, 1);
    Film test{reference.frame, reference.window, {}};
    test.add("hit.steps", ChannelType::uint32).bits = {99, 16777217, 0};
    EXPECT_TRUE(judge_films(reference, test).passes());
    test.planes[0].bits[0] = 98;
    EXPECT_EQ(judge_films(reference, test).channels[0].count(LegalVerdict::fail), 1u);
    test.planes[0] = {"hit.steps", ChannelType::float32, {bits(100.5f), bits(16777216), bits(0)}};
    EXPECT_TRUE(judge_films(reference, test).passes());
}

TEST(Legal, WhatIsLackingIsOneLineEach) {
    Film reference = reference_film();
    reference.add("Z", ChannelType::float32);
    reference.add("G", ChannelType::float32);
    reference.add("gpu.lo.G", ChannelType::float32);
    reference.add("gpu.hi.G", ChannelType::float32);
    reference.add("B", ChannelType::float32);
    for (const char* part : {"gpu.lo.B", "gpu.hi.B", "gpu.paths.B", "gpu.lo.A"})
        reference.add(part, ChannelType::float32);
    Film test = test_film(reference);
    test.add("Q", ChannelType::float32);
    const LegalReport report = judge_films(reference, test);
    EXPECT_FALSE(report.passes());
    EXPECT_EQ(report.structure,
              (std::vector<std::string>{
                  "channel A: the reference has its range and no value",
                  "channel B: gpu.paths.B of the reference: found floats, expected integers",
                  "channel G: the reference lacks gpu.paths.G"}));
    EXPECT_EQ(report.notes,
              (std::vector<std::string>{"not judged, the reference holds no range of: Z",
                                        "not judged, the reference lacks: Q"}));
    Film nothing{reference.frame, reference.window, {}};
    const LegalReport empty = judge_films(reference_film(), nothing);
    EXPECT_EQ(empty.structure, std::vector<std::string>{"channel R: missing in the test image"});
    EXPECT_FALSE(empty.passes());
    EXPECT_THROW(take_apart(test, "ref.exr"), InputError);
}

TEST(Legal, AReferenceThatContradictsItselfIsToldOf) {
    Film reference = reference_film();
    const Film test = test_film(reference);
    reference.find("R")->bits[3] = bits(5);
    std::swap(reference.find("gpu.lo.R")->bits[4], reference.find("gpu.hi.R")->bits[4]);
    const LegalReport report = judge_films(reference, test);
    EXPECT_EQ(report.channels[0].empty_ranges, 1u);
    EXPECT_EQ(report.channels[0].reference_outside, 2u);
    EXPECT_EQ(report.channels[0].count(LegalVerdict::fail), 1u);
    EXPECT_NE(to_text(report).find("outside of its range at 1 pixels"), std::string::npos);
}

TEST(Legal, JsonSaysTheSame) {
    const Film reference = reference_film();
    Film test = test_film(reference);
    test.planes[0].bits[0] = canonical_nan;
    const auto json = nlohmann::json::parse(to_json(judge_films(reference, test)));
    EXPECT_EQ(json["legal"], false);
    EXPECT_EQ(json["channels"][0]["fail"], 1);
    EXPECT_EQ(json["channels"][0]["pass"], 79);
    EXPECT_EQ(json["channels"][0]["nan"], 1);
    EXPECT_EQ(json["channels"][0]["worst"][0]["test"], "nan");
    EXPECT_EQ(json["channels"][0]["worst"][0]["range"]["paths"], 1);
    EXPECT_EQ(json["most_ambiguous"], 0.05);
}

/// Each verdict has a colour of its own, at its pixel.
TEST(Legal, ThePictureHasFourColours) {
    Film reference = reference_film();
    Film test = test_film(reference);
    reference.find("gpu.paths.R")->bits[reference.index(3, 1)] = 2;
    reference.find("gpu.paths.R")->bits[reference.index(4, 1)] = 0;
    move_pixel(test, 5, 1, 0.5f);
    LegalRules rules;
    rules.left_out.assign(80, false);
    rules.left_out[4] = true;
    const Picture picture = legal_picture(take_apart(reference, ""), test, rules);
    std::set<std::vector<std::uint8_t>> colours;
    for (int x = 2; x < 7; ++x) {
        constexpr int margin = 4;
        const auto at = 3 * static_cast<std::size_t>(margin * picture.width + margin + x - 2);
        colours.insert({picture.rgb.begin() + static_cast<std::ptrdiff_t>(at),
                        picture.rgb.begin() + static_cast<std::ptrdiff_t>(at) + 3});
    }
    EXPECT_EQ(colours.size(), 5u);
    EXPECT_TRUE(colours.count({0, 0, 0}) == 1);
    EXPECT_TRUE(colours.count({213, 94, 0}) == 1);
    EXPECT_THROW(legal_picture(take_apart(reference, ""), Film{reference.frame, {}, {}}, rules),
                 UsageError);
}

}  // namespace
}  // namespace quadrel
