// quadrel-stress: a short run of it, and that it finds what it looks for.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "effort.hpp"
#include "film/films.hpp"
#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

/// Runs `quadrel-stress arguments`, standard error aside.
Outcome run_stress(const std::string& arguments) {
    return run_command(QUADREL_STRESS " " + arguments + " 2>/dev/null");
}

TEST(Stress, AShortRunFindsNothing) {
    // Marches of 65536 steps, which the lists have, take minutes under the sanitizers.
    const Outcome outcome = run_stress(test::sanitized ? "--scenes 6 --lists 0 --seconds 120"
                                                       : "--scenes 30 --lists 100 --seconds 120");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("No crash, no hang"), std::string::npos);
    EXPECT_EQ(outcome.out.find("e+02"), std::string::npos) << outcome.out;  // 100 % as "1e+02"
}

TEST(Stress, PlantedErrorsAreFound) {
    const Outcome outcome = run_stress("--planted");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("planted errors: all 9 found"), std::string::npos) << outcome.out;
}

TEST(Stress, AnySceneCanBeHadAlone) {
    const Outcome once = run_stress("--seed 7 --only 12");
    EXPECT_EQ(once.code, 0);
    EXPECT_EQ(nlohmann::json::parse(once.out)["quadrel"], 1);
    EXPECT_EQ(run_stress("--seed 7 --only random/12").out, once.out);
    EXPECT_NE(run_stress("--seed 8 --only 12").out, once.out);
    EXPECT_NE(run_stress("--seed 7 --only 13").out, once.out);
    const testing_films::TemporaryFolder folder;
    const std::string into = " -o " + folder.path().string();
    EXPECT_EQ(run_stress("--only 'E.1/wall-x/max-mip'" + into).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "scene.json"));
    EXPECT_TRUE(std::filesystem::exists(folder / "wall-x-64x64.exr"));
    EXPECT_NE(run_stress("--list").out.find("\nE.1/wall-x/max-mip\n"), std::string::npos);
}

/// The scene is the same on every machine and by every compiler: this one was written down.
TEST(Stress, NumbersAreTheSameEverywhere) {
    const auto scene = nlohmann::json::parse(run_stress("--seed 1 --only 3").out);
    EXPECT_EQ(scene["size"].dump() + scene["conventions"].get<std::string>(), "[28,17]vulkan");
    EXPECT_EQ(scene["materials"]["stress"]["relief"]["trace"], "steep-adaptive");
}

TEST(Stress, NonsenseIsRefused) {
    for (const char* arguments :
         {"--only nonsense", "--only 12x", "--scenes -1", "--processes 0", "--seconds 0",
          "--seconds nan", "--lists -1", "--nonsense", "extra", "--plot p.svg", "-o folder",
          "--list --planted", "--only 12 --ranges frame"})
        EXPECT_EQ(run_stress(arguments).code, 2) << arguments;
    const testing_films::TemporaryFolder folder;
    testing_films::write_bytes(folder / "file", "x");
    EXPECT_EQ(run_stress("--only 12 -o " + (folder / "file").string()).code, 5);
}

}  // namespace
}  // namespace quadrel::tools_tests
