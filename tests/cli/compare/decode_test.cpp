// compare --decode on files, and what export gives to pack them with.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "io/image/png_codes.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;

/// A reference of all kinds of floats, and a screenshot that carries one channel.
class Decode : public testing::Test {
  protected:
    Decode() : film(testing_films::random_film(11, {0, 0, 12, 8}, {0, 0, 12, 8})) {
        canonicalize(film);
        write_exr(folder / "ref.exr", film, {});
        shoot("shot.png", *film.find("uv.U"));
    }
    void shoot(const std::string& name, const Plane& plane) {
        std::vector<std::uint8_t> codes;
        for (const std::uint32_t bits : plane.bits)
            for (int shift = 0; shift < 32; shift += 8)
                codes.push_back(static_cast<std::uint8_t>(bits >> shift));
        write_png_codes(folder / name, 12, 8, 4, codes);
    }
    Outcome compare(std::vector<std::string> words) {
        words.insert(words.begin(), "compare");
        return run(words, folder.path());
    }
    Film film;
    TemporaryFolder folder;
};

TEST_F(Decode, AScreenshotIsJudgedBitForBit) {
    for (const bool shot_first : {false, true}) {
        std::vector<std::string> words = {"ref.exr", "shot.png", "--decode", "bits:uv.U", "--json"};
        if (shot_first) std::swap(words[0], words[1]);
        const Outcome outcome = compare(words);
        EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
        const auto json = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(json["channels"].size(), 1u);
        EXPECT_EQ(json["preparation"]["reference"], "ref.exr");
        EXPECT_EQ(json["preparation"]["decoded"][0], "uv.U: bits of shot.png");
    }
    Plane wrong = *film.find("uv.U");
    wrong.bits[20] ^= 1u << 9;
    shoot("wrong.png", wrong);
    const Outcome outcome = compare({"wrong.png", "ref.exr", "--decode", "bits:uv.U"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("1 of 96 differ"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("8,1"), std::string::npos);
    shoot("z.png", *film.find("Z"));
    EXPECT_EQ(
        compare({"ref.exr", "shot.png", "--decode", "bits:uv.U", "--decode", "bits:Z=z.png"}).code,
        0);
}

TEST_F(Decode, WhatMakesNoSenseIsOneLine) {
    const auto refuses = [&](const std::vector<std::string>& words, int code) {
        const Outcome outcome = compare(words);
        const bool one_line = std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1;
        return outcome.code == code && one_line
                   ? testing::AssertionSuccess()
                   : testing::AssertionFailure() << outcome.code << outcome.err;
    };
    write_png_codes(folder / "small.png", 6, 8, 4, std::vector<std::uint8_t>(6 * 8 * 4, 7));
    EXPECT_TRUE(refuses({"ref.exr", "small.png", "--decode", "bits:uv.U"}, 3));
    EXPECT_TRUE(refuses({"ref.exr", "shot.png", "--decode", "uv.U"}, 2));
    EXPECT_TRUE(refuses({"shot.png", "shot.png", "--decode", "bits:R"}, 2));
}

TEST_F(Decode, ThePatternIsWhatTheSnippetsSay) {
    const Outcome made = run({"export", "--pattern", "12x8", "-o", "pattern.exr"}, folder.path());
    EXPECT_EQ(made.code, 0) << made.err;
    Plane pattern{"pattern", ChannelType::uint32, {}};
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 12; ++x)
            pattern.bits.push_back(x * 0x9e3779b1u + y * 0x85ebca77u);
    shoot("pattern.png", pattern);
    EXPECT_EQ(compare({"pattern.exr", "pattern.png", "--decode", "bits:pattern"}).code, 0);
    EXPECT_EQ(run({"export", "--pattern", "12x8"}).code, 2);
}

TEST(Snippets, ArePrinted) {
    for (const char* language : {"glsl", "glsl-es", "hlsl", "wgsl"}) {
        const Outcome outcome = run({"export", "--snippets", "--language", language});
        EXPECT_EQ(outcome.code, 0);
        for (const char* name :
             {"value_bits", "pack_rgba8", "pack_rgb8", "pack_rg16", "pack_rgb10a2", "pattern_bits"})
            EXPECT_NE(outcome.out.find(name), std::string::npos) << language << name;
    }
    EXPECT_EQ(run({"export", "--snippets"}).code, 0);
    EXPECT_EQ(run({"export", "--snippets", "--language", "msl"}).code, 2);
}

}  // namespace
}  // namespace quadrel::cli_tests
