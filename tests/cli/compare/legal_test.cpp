// quadrel compare --legal on files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;

/// A reference whose R, G and B may be 0.002 off, and images to judge by it.
class LegalFiles : public testing::Test {
  protected:
    LegalFiles() {
        test = testing_films::smooth_film(3);
        reference = test;
        for (const char* name : {"R", "G", "B"}) {
            const Plane values = *test.find(name);
            for (const auto& [prefix, by] : {std::pair{"gpu.lo.", -0.002f}, {"gpu.hi.", 0.002f}}) {
                Plane& plane = reference.add(prefix + values.name, ChannelType::float32);
                for (std::size_t i = 0; i < plane.bits.size(); ++i)
                    plane.bits[i] = testing_films::bits(values.as_float(i) + by);
            }
            reference.add("gpu.paths." + values.name, ChannelType::uint32, 1);
        }
        reference.add("Z", ChannelType::float32);
        write_exr(folder / "ref.exr", reference, {});
        write_exr(folder / "good.exr", test, {});
        Film bad = test;
        bad.find("G")->bits[bad.index(4, 2)] = testing_films::bits(2);
        write_exr(folder / "bad.exr", bad, {});
    }
    Outcome compare(std::vector<std::string> options) {
        options.insert(options.begin(), "compare");
        return run(options, folder.path());
    }
    /// The image moved by an error that looks like one of a port.
    Outcome judge_with(const std::function<void(Film&)>& error) {
        Film film = test;
        error(film);
        write_exr(folder / "planted.exr", film, {});
        return compare({"ref.exr", "--legal", "planted.exr"});
    }
    TemporaryFolder folder;
    Film reference, test;
};

TEST_F(LegalFiles, ExitCodesTellLegalFromNot) {
    const Outcome good = compare({"ref.exr", "--legal", "good.exr"});
    EXPECT_EQ(good.code, 0) << good.out << good.err;
    EXPECT_TRUE(good.out.ends_with("legal\n"));
    EXPECT_NE(good.out.find("holds no range of: Z"), std::string::npos) << good.out;
    const Outcome bad = compare({"ref.exr", "bad.exr", "--legal"});
    EXPECT_EQ(bad.code, 1);
    EXPECT_NE(bad.out.find("worst at 4,2: test 2 "), std::string::npos) << bad.out;
    EXPECT_EQ(compare({"ref.exr", "bad.exr", "--legal", "--channels", "R,B"}).code, 0);
    EXPECT_EQ(compare({"ref.exr", "bad.exr", "--legal", "--window", "0,0,16,2"}).code, 0);
    EXPECT_EQ(compare({"ref.exr", "good.exr", "--legal", "--widest", "0.001"}).code, 1);
    EXPECT_EQ(compare({"ref.exr", "good.exr", "--legal", "--widest", "0.001",
                       "--most-unconstrained", "1"})
                  .code,
              0);
}

TEST_F(LegalFiles, PlantedErrorsFail) {
    EXPECT_EQ(judge_with([](Film&) {}).code, 0);
    EXPECT_EQ(
        judge_with([](Film& film) { std::swap(film.planes[0].bits, film.planes[1].bits); }).code,
        1);
    EXPECT_EQ(judge_with([](Film& film) { flip_y(film); }).code, 1);
    EXPECT_EQ(judge_with([](Film& film) { film.planes[2].bits[7] = canonical_nan; }).code, 1);
    EXPECT_EQ(judge_with([](Film& film) { film.planes.pop_back(); }).code, 1);
    EXPECT_EQ(judge_with([](Film& film) { crop(film, {0, 0, 15, 9}); }).code, 1);
    const Outcome resized = judge_with([](Film& film) { film.frame = {0, 0, 17, 9}; });
    EXPECT_EQ(resized.code, 1);
    EXPECT_NE(resized.out.find("frame: reference 16x9"), std::string::npos) << resized.out;
}

TEST_F(LegalFiles, EightBitPortsAreJudgedByCodes) {
    write_png(folder / "port.png", preview(test));
    EXPECT_EQ(compare({"ref.exr", "port.png", "--legal"}).code, 1);
    const Outcome encoded =
        compare({"ref.exr", "port.png", "--legal", "--encode", "srgb8", "--json"});
    EXPECT_EQ(encoded.code, 0) << encoded.out;
    EXPECT_EQ(nlohmann::json::parse(encoded.out)["channels"][0]["encoding"], "srgb8");
    write_png(folder / "wrong.png", preview(testing_films::smooth_film(4)));
    EXPECT_EQ(compare({"ref.exr", "wrong.png", "--legal", "--encode", "srgb8"}).code, 1);
}

TEST_F(LegalFiles, JsonAndAHeatMap) {
    const Outcome outcome =
        compare({"ref.exr", "bad.exr", "--legal", "--json", "--heatmap", "heat.png"});
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["legal"], false);
    EXPECT_EQ(json["preparation"]["test"], "bad.exr");
    EXPECT_EQ(testing_films::file_bytes(folder / "heat.png").substr(1, 3), "PNG");
}

TEST_F(LegalFiles, NonsenseIsOneLine) {
    const std::vector<std::pair<int, std::vector<std::string>>> lines = {
        {2, {"ref.exr", "good.exr", "--legal", "--abs", "1"}},
        {2, {"ref.exr", "good.exr", "--legal", "--fraction", "R=0.5"}},
        {2, {"ref.exr", "good.exr", "--legal", "--blame", "bricks-45"}},
        {2, {"ref.exr", "good.exr", "--legal", "--widest", "10"}},
        {2, {"ref.exr", "good.exr", "--legal", "--widest", "nan"}},
        {2, {"ref.exr", "good.exr", "--legal", "--most-ambiguous", "-0.1"}},
        {2, {"ref.exr", "good.exr", "--legal", "--most-unconstrained", "1%"}},
        {2, {"ref.exr", "good.exr", "--widest", "0.5"}},
        {2, {"ref.exr", "good.exr", "--legal", "--channels", "Z"}},
        {2, {"ref.exr", "good.exr", "--legal", "--channels", "gpu.lo.R"}},
        {2, {"ref.exr", "--legal"}},
        {3, {"good.exr", "ref.exr", "--legal"}},
        {3, {"none.exr", "ref.exr", "--legal"}},
    };
    for (const auto& [code, line] : lines) {
        const Outcome outcome = compare(line);
        EXPECT_EQ(outcome.code, code) << line.back() << outcome.err;
        EXPECT_EQ(outcome.out, "") << line.back();
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
