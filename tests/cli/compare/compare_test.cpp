// quadrel compare and quadrel info on files.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;

/// Two files that differ by one ulp in R and by more in G.
class CompareFiles : public testing::Test {
  protected:
    CompareFiles() {
        Film film = testing_films::smooth_film(1);
        film.planes[0].bits[3] = film.planes[1].bits[4] = 0x3f800000;
        write_exr(folder / "a.exr", film, {{"quadrel:note", "one"}});
        film.planes[0].bits[3] += 1;
        film.planes[1].bits[4] = 0x3f900000;  // 1.125
        write_exr(folder / "b.exr", film, {});
    }
    Outcome compare(std::vector<std::string> options) {
        options.insert(options.begin(), "compare");
        return run(options, folder.path());
    }
    TemporaryFolder folder;
};

TEST_F(CompareFiles, ExitCodesTellEqualFromDifferent) {
    EXPECT_EQ(compare({"a.exr", "a.exr"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--channels", "B"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--channels", "R,B"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--channels", "R,B", "--ulp", "1"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--abs", "0.125"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--rel", "0.12"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--channels", "Q"}).code, 2);
}

/// Pixels that the reference flags are not compared; counts and heat maps do without them.
TEST_F(CompareFiles, FlaggedPixelsAreLeftOut) {
    for (const char* name : {"a.exr", "b.exr"}) {
        Film film = read_exr(folder / name).film;
        Plane& flags = film.add("hit.flags", ChannelType::uint32);
        flags.bits[3] = 32;
        flags.bits[4] = 32 + 8;
        flags.bits[5] = 2;
        write_exr(folder / (std::string("flagged_") + name), film, {});
    }
    const auto ignoring = [&](const std::string& flags) {
        return compare({"flagged_a.exr", "flagged_b.exr", "--json", "--ignore-flags", flags});
    };
    EXPECT_EQ(compare({"flagged_a.exr", "flagged_b.exr"}).code, 1);
    EXPECT_EQ(ignoring("nan-look-up").code, 0);
    EXPECT_EQ(ignoring("ambiguous,wrapped").code, 1);  // G alone is left out
    const auto json = nlohmann::json::parse(ignoring("nan-look-up,ambiguous").out);
    EXPECT_EQ(json["left_out"], 3);
    const auto all = nlohmann::json::parse(ignoring("start-below").out);
    EXPECT_EQ(all["channels"][0]["pixels"].get<int>() - 3,
              json["channels"][0]["pixels"].get<int>());
    EXPECT_EQ(ignoring("nan-lookup").code, 2);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--ignore-flags", "wrapped"}).code, 2);
    EXPECT_EQ(compare({"flagged_a.exr", "flagged_b.exr", "--channels", "R,G", "--ignore-flags",
                       "nan-look-up", "--heatmap", "heat.png"})
                  .code,
              0);
}

TEST_F(CompareFiles, JsonNamesTheWorstPixel) {
    const Outcome outcome = compare({"a.exr", "b.exr", "--json"});
    EXPECT_EQ(outcome.code, 1);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["equal"], false);
    for (const auto& channel : json["channels"])
        if (channel["name"] == "G") {
            EXPECT_EQ(channel["worst"][0]["x"], 4);
            EXPECT_EQ(channel["worst"][0]["test"], 1.125);
            EXPECT_EQ(channel["worst"][0]["test_bits"], "0x3f900000");
            EXPECT_EQ(channel["max_abs"], 0.125);
        }
}

TEST_F(CompareFiles, HeatmapIsWritten) {
    EXPECT_EQ(compare({"a.exr", "b.exr", "--heatmap", "heat.png"}).code, 1);
    EXPECT_EQ(testing_films::file_bytes(folder / "heat.png").substr(1, 3), "PNG");
    EXPECT_EQ(compare({"a.exr", "b.exr", "--heatmap", "missing/heat.png"}).code, 5);
}

TEST_F(CompareFiles, TolerancesForOneChannel) {
    EXPECT_EQ(compare({"a.exr", "b.exr", "--abs", "G=0.125"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--abs", "G=0.125", "--ulp", "R=1"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--abs", "1", "--abs", "G=0.1"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--abs", "G=1", "--abs", "0"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--fraction", "0.007"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--fraction", "0.0069"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "b.exr", "--fraction", "G=0.007", "--ulp", "1"}).code, 0);
    const auto json =
        nlohmann::json::parse(compare({"a.exr", "b.exr", "--json", "--abs", "G=0.5"}).out);
    for (const auto& channel : json["channels"]) {
        EXPECT_EQ(channel["tolerance"]["abs"], channel["name"] == "G" ? 0.5 : 0.0);
        EXPECT_EQ(channel["passes"], channel["name"] != "R");
    }
}

TEST_F(CompareFiles, NonsenseIsOneLineAndCode2) {
    const std::vector<std::vector<std::string>> lines = {
        {"--abs", "Q=1"},
        {"--abs", "R=-1"},
        {"--abs", "R="},
        {"--abs", "nan"},
        {"--ulp", "1.5"},
        {"--ulp", "R=x"},
        {"--fraction", "2"},
        {"--fraction", "=1"},
        {"--encode", "srgb"},
        {"--map", "R"},
        {"--map", "R=Q"},
        {"--map", "=R"},
        {"--map", "R=G", "--map", "R=B"},
        {"-D", "size=[4,4]"},
    };
    for (std::vector<std::string> line : lines) {
        const std::string text = line[0] + " " + line[1];
        line.insert(line.begin(), {"a.exr", "b.exr"});
        const Outcome outcome = compare(line);
        EXPECT_EQ(outcome.code, 2) << text;
        EXPECT_EQ(outcome.out, "") << text;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

TEST_F(CompareFiles, AnotherSizeIsADifferenceEvenWithAHeatMap) {
    write_exr(folder / "small.exr", testing_films::smooth_film(1, {0, 0, 8, 9}), {});
    const Outcome outcome = compare({"a.exr", "small.exr", "--heatmap", "heat.png"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("window: reference 16x9"), std::string::npos) << outcome.out;
    EXPECT_FALSE(std::filesystem::exists(folder / "heat.png"));
}

TEST_F(CompareFiles, ThePreparationIsRecorded) {
    Film film = read_exr(folder / "a.exr").film;
    flip_y(film);
    for (Plane& plane : film.planes) plane.name = "port." + plane.name;
    film.add("port.Z", ChannelType::float32);
    write_exr(folder / "port.exr", film, {});
    EXPECT_EQ(compare({"a.exr", "port.exr"}).code, 1);
    const std::vector<std::string> line = {"a.exr", "port.exr", "--flip-y", "--map",   "R=port.R",
                                           "--map", "G=port.G", "--map",    "B=port.B"};
    std::vector<std::string> options = line;
    EXPECT_EQ(compare(options).code, 1) << "port.Z is too much";
    options.insert(options.end(), {"--channels", "R,G,B"});
    const Outcome text = compare(options);
    EXPECT_EQ(text.code, 0) << text.out;
    EXPECT_NE(text.out.find("test flipped in y"), std::string::npos);
    EXPECT_NE(text.out.find("channel R is port.R of the test"), std::string::npos);
    options.push_back("--json");
    const auto json = nlohmann::json::parse(compare(options).out);
    EXPECT_EQ(json["preparation"]["flip_y"], true);
    EXPECT_EQ(json["preparation"]["map"]["G"], "port.G");
    EXPECT_EQ(json["preparation"]["encode"], "none");
    EXPECT_EQ(
        compare({"a.exr", "port.exr", "--flip-y", "--layer", "port", "--channels", "R,G,B"}).code,
        0);
}

TEST_F(CompareFiles, AnEightBitPort) {
    const Film film = read_exr(folder / "a.exr").film;
    write_png(folder / "port.png", preview(film));
    EXPECT_EQ(compare({"a.exr", "port.png"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "port.png", "--encode", "srgb8"}).code, 0);
    EXPECT_EQ(compare({"a.exr", "port.png", "--encode", "unorm8"}).code, 1);
    EXPECT_EQ(compare({"a.exr", "port.png", "--encode", "half"}).code, 3);
    write_png(folder / "wrong.png", preview(testing_films::smooth_film(2)));
    const Outcome wrong = compare({"a.exr", "wrong.png", "--encode", "srgb8"});
    EXPECT_EQ(wrong.code, 1);
    EXPECT_NE(wrong.out.find("test wrong.png (unorm8)\nencoded as srgb8"), std::string::npos);
    EXPECT_NE(wrong.out.find("(code "), std::string::npos) << wrong.out;
    testing_films::write_bytes(folder / "bad.png", "none");
    EXPECT_EQ(compare({"a.exr", "bad.png"}).code, 3);
}

/// A render, and a port whose hit is wrong at one pixel, and so its colour.
class BlamePort : public testing::Test {
  protected:
    BlamePort() {
        const Outcome outcome = run({"render", "bricks-45", "--size", "32x24", "--channels",
                                     "R,G,B,uv,hit,id", "-D", steps, "-o", "a.exr"},
                                    folder.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        Film film = read_exr(folder / "a.exr").film;
        for (Plane& plane : film.planes)
            if (plane.name == "hit.s" || plane.name == "R")
                plane.bits[film.index(17, 12)] = 0x40000000;
        write_exr(folder / "port.exr", film, {});
    }
    Outcome blame(std::vector<std::string> options) {
        options.insert(options.begin(), {"compare", "a.exr", "port.exr", "--blame"});
        return run(options, folder.path());
    }
    const std::string steps = "material.relief.steps=32";
    TemporaryFolder folder;
};

TEST_F(BlamePort, NamesTheHitAndTheProbeThatShowsIt) {
    const Outcome text = blame({"bricks-45", "-D", steps});
    EXPECT_EQ(text.code, 1) << text.err;
    const std::string command =
        "quadrel probe bricks-45 --pixel 17,12 -D " + steps + " --size 32x24";
    EXPECT_NE(text.out.find("first wrong there: hit.s"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("look: " + command + "\n"), std::string::npos) << text.out;
    const auto json = nlohmann::json::parse(blame({"bricks-45", "-D", steps, "--json"}).out);
    EXPECT_EQ(json["blame"]["first"], "hit.s");
    EXPECT_EQ(json["blame"]["symptom"], "R");
    EXPECT_EQ(json["blame"]["command"], command);
    EXPECT_EQ(json["blame"]["same_scene"], true);
    EXPECT_EQ(run({"probe", "bricks-45", "--pixel", "17,12", "-D", steps, "--size", "32x24"}).code,
              0);
}

TEST_F(BlamePort, AnotherSceneIsNoticedAndAMissingOneRefused) {
    const auto json = nlohmann::json::parse(blame({"bricks-45", "--json"}).out);
    EXPECT_EQ(json["blame"]["same_scene"], false);
    EXPECT_NE(blame({"bricks-45"}).out.find("another scene"), std::string::npos);
    EXPECT_EQ(blame({"no-such-scene"}).code, 3);
    EXPECT_EQ(run({"compare", "a.exr", "a.exr", "--blame", "bricks-45"}, folder.path()).code, 0);
}

TEST_F(CompareFiles, InfoDescribesAnExr) {
    const Outcome outcome = run({"info", "a.exr", "--json"}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["window"], "16x9 at 0,0");
    EXPECT_EQ(json["channels"].size(), 3u);
    EXPECT_EQ(json["channels"][0]["nan"], 0);
    EXPECT_EQ(json["attributes"]["quadrel:note"], "one");
    const Outcome text = run({"info", "a.exr"}, folder.path());
    EXPECT_NE(text.out.find("quadrel:note = one"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::cli_tests
