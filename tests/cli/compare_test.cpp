// quadrel compare and quadrel info on files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

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

TEST_F(CompareFiles, JsonNamesTheWorstPixel) {
    const Outcome outcome = compare({"a.exr", "b.exr", "--json"});
    EXPECT_EQ(outcome.code, 1);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["equal"], false);
    for (const auto& channel : json["channels"])
        if (channel["name"] == "G") {
            EXPECT_EQ(channel["worst"]["x"], 4);
            EXPECT_EQ(channel["max_abs"], 0.125);
        }
}

TEST_F(CompareFiles, HeatmapIsWritten) {
    EXPECT_EQ(compare({"a.exr", "b.exr", "--heatmap", "heat.png"}).code, 1);
    EXPECT_EQ(testing_films::file_bytes(folder / "heat.png").substr(1, 3), "PNG");
    EXPECT_EQ(compare({"a.exr", "b.exr", "--heatmap", "missing/heat.png"}).code, 5);
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
