// quadrel errors, and compare --against.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;
using Words = std::vector<std::string>;

constexpr const char* part_of_scene = "bricks-45";

Outcome errors(const Words& options) {
    Words words{"errors", part_of_scene, "--size", "40x30"};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
}

std::uint64_t kinds_of(const nlohmann::json& summary, const std::string& kind) {
    return summary["parts"][0]["kinds"][kind].get<std::uint64_t>();
}

TEST(Errors, AreToldForPeopleAndPrograms) {
    const Outcome text = errors({"-D", "material.relief.steps=16"});
    EXPECT_EQ(text.code, 0);
    for (const char* part : {"late", "other surface", "99.9 %", "uv (texels)", "quadrel probe "})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << text.out;
    const auto coarse =
        nlohmann::json::parse(errors({"-D", "material.relief.steps=16", "--json"}).out);
    const auto exact = nlohmann::json::parse(
        errors({"-D", "material.relief.trace=oracle-bilinear", "--json"}).out);
    EXPECT_GT(kinds_of(coarse, "late"), kinds_of(coarse, "same"));
    EXPECT_EQ(kinds_of(exact, "late"), 0u);
    EXPECT_EQ(exact["certified"], exact["judged"]);
}

TEST(Errors, CommandsOfTheWorstPixelsRun) {
    const auto json = nlohmann::json::parse(errors({"--json", "--worst", "1"}).out);
    std::string command = json["worst"][0]["command"];
    EXPECT_TRUE(command.starts_with("quadrel probe ")) << command;
    std::erase(command, '\'');  // a shell's
    Words words;
    std::istringstream stream(command);
    for (std::string word; stream >> word;) words.push_back(word);
    words.erase(words.begin());
    EXPECT_EQ(run(words).code, 0) << command;
}

TEST(Errors, BadArgumentsAreRefused) {
    EXPECT_EQ(errors({"--window", "0,0,50,10"}).code, 2);
    EXPECT_EQ(errors({"--number", "half"}).code, 2);
    EXPECT_EQ(run({"errors", "no-such-scene"}).code, 3);
    EXPECT_EQ(run({"errors"}).code, 2);
}

/// A port's image of the scene, right and with its hits a texel aside.
class Against : public testing::Test {
  protected:
    Against() {
        run({"render", part_of_scene, "--size", "40x30", "--channels", "A,hit,N,R,G,B", "-o",
             (folder / "port.exr").string()});
        Film film = read_exr(folder / "port.exr").film;
        for (std::uint32_t& bits : film.find("hit.U")->bits)
            bits = std::bit_cast<std::uint32_t>(std::bit_cast<float>(bits) + 1.0f / 512);
        write_exr(folder / "shifted.exr", film, {});
        for (Plane& plane : film.planes) plane.name = "port_" + plane.name;
        write_exr(folder / "renamed.exr", film, {});
    }
    Outcome against(const Words& options) {
        Words words{"compare", part_of_scene};
        words.insert(words.end(), options.begin(), options.end());
        words.insert(words.end(), {"--against", "oracle"});
        return run(words, folder.path());
    }
    nlohmann::json judged(Words options) {
        options.push_back("--json");
        return nlohmann::json::parse(against(options).out);
    }
    TemporaryFolder folder;
};

TEST_F(Against, AnImageIsJudgedAsItsScene) {
    const auto scene = nlohmann::json::parse(errors({"--json"}).out);
    const auto port = judged({"port.exr"});
    EXPECT_EQ(port["parts"][0]["kinds"], scene["parts"][0]["kinds"]);
    EXPECT_EQ(port["image"], "port.exr");
    const auto shifted = judged({"shifted.exr"});
    EXPECT_EQ(kinds_of(shifted, "same"), 0u);
    EXPECT_NE(shifted["parts"][0]["errors"][1]["p50"], port["parts"][0]["errors"][1]["p50"]);
    const auto renamed = judged({"renamed.exr", "--map", "hit.U=port_hit.U", "--map",
                                 "hit.V=port_hit.V", "--map", "hit.s=port_hit.s"});
    EXPECT_EQ(kinds_of(renamed, "same"), 0u);
    EXPECT_EQ(judged({"port.exr", "--channels", "N"})["parts"][0]["errors"].size(), 1u);
}

/// The exit code is that of tolerances, where some are given.
TEST_F(Against, TolerancesAreOfErrors) {
    const auto code = [&](const Words& options) {
        Words words{"port.exr"};
        words.insert(words.end(), options.begin(), options.end());
        return against(words).code;
    };
    const double most = judged({"port.exr"})["parts"][0]["errors"][1]["max"];
    EXPECT_EQ(code({"--abs", "err.uv=" + std::to_string(1.01 * most)}), 0);
    EXPECT_EQ(code({"--abs", "err.uv=" + std::to_string(0.9 * most)}), 1);
    EXPECT_EQ(code({"--abs", "err.uv=" + std::to_string(0.9 * most), "--fraction", "err.uv=0.5"}),
              0);
    EXPECT_EQ(code({"--abs", "err.color=10", "--abs", "err.normal=180"}), 0);
    const auto json = judged({"port.exr", "--abs", "err.uv=0"});
    EXPECT_EQ(json["tolerances"]["equal"], false);
    EXPECT_EQ(json["tolerances"]["channels"].size(), 1u);
}

TEST_F(Against, OptionsWithoutAMeaningAreRefused) {
    for (const Words& options :
         {Words{"--abs", "1"}, Words{"--rel", "err.uv=1"}, Words{"--abs", "err.normal.X=1"},
          Words{"--encode", "half"}, Words{"--blame", "bricks-45"}, Words{"--heatmap", "a.png"},
          Words{"--overlap"}, Words{"--window", "0,0,90,90"}}) {
        Words words{"port.exr"};
        words.insert(words.end(), options.begin(), options.end());
        EXPECT_EQ(against(words).code, 2) << options[0];
    }
    EXPECT_EQ(against({"renamed.exr"}).code, 2);
    EXPECT_EQ(against({"missing.exr"}).code, 3);
    EXPECT_EQ(
        run({"compare", part_of_scene, (folder / "port.exr").string(), "--against", "me"}).code, 2);
}

}  // namespace
}  // namespace quadrel::cli_tests
