// quadrel-stress: a short run of it, and that it finds what it looks for.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "effort.hpp"
#include "file/read_file.hpp"
#include "film/films.hpp"
#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

/// Runs `quadrel-stress arguments`, standard error aside.
Outcome run_stress(const std::string& arguments) {
    return run_command(QUADREL_STRESS " " + arguments + " 2>/dev/null");
}

TEST(Stress, AShortRunFindsNothing) {
    const Outcome outcome =
        run_stress(test::sanitized ? "--scenes 4 --lists 200 --look-ups 2e4 --seconds 120"
                                   : "--scenes 30 --lists 100 --seconds 120");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_NE(outcome.out.find("No crash, no hang"), std::string::npos);
    EXPECT_EQ(outcome.out.find("e+02"), std::string::npos) << outcome.out;  // 100 % as "1e+02"
}

/// Marches of 65536 steps, rays over a million tiles, ten thousand rays towards the sky a fragment.
TEST(Stress, ScenesThatWouldTakeLongAreDrawnInPart) {
    std::vector<std::string> names{"E.4/shadow-march-thesis, steps 65536",
                                   "E.3/1e5 tiles/frame-gram/qdm"};
    if (!test::sanitized)  // a quad of these alone takes a second
        names.insert(names.end(),
                     {"E.4/ao-oracle, samples 65536", "E.4/depth 1000000/oracle-bilinear"});
    for (const std::string& name : names) {
        const testing_films::TemporaryFolder folder;
        const std::string once = "--look-ups 2e4 --only '" + name + "' -o ";
        const Outcome outcome = run_stress(once + folder.path().string());
        EXPECT_EQ(outcome.code, 0) << outcome.out;
        EXPECT_NE(outcome.out.find("1 would have taken too long: 4 of their 256 pixels"),
                  std::string::npos)
            << outcome.out;
    }
    const testing_films::TemporaryFolder folder;
    const Outcome plain = run_stress("--only 'E.1/wall-x/linear' -o " + folder.path().string());
    EXPECT_EQ(plain.out.find("too long:"), std::string::npos) << plain.out;
}

/// Of a log everything up to `end` lines; the last one without its end.
std::string cut_off(const std::string& log, int lines) {
    std::size_t end = 0;
    for (int i = 0; i < lines; ++i) end = log.find('\n', end) + 1;
    return log.substr(0, end + 40);
}

TEST(Stress, ARunThatWasEndedGoesOn) {
    const testing_films::TemporaryFolder folder;
    const std::string file = (folder / "log").string();
    const auto logged = [&](const std::string& more) {
        return run_stress("--lists 0 --look-ups 2e4 " + more + " --log " + file);
    };
    const Outcome whole = logged("--scenes 4");
    EXPECT_EQ(whole.code, 0) << whole.out;
    const std::string log = read_whole_file(file);
    testing_films::write_bytes(file, cut_off(log, 3));
    EXPECT_EQ(logged("--scenes 4").out, whole.out);
    EXPECT_EQ(read_whole_file(file), log);
    // What the log has is not run again, whatever it says.
    std::string other = log;
    const std::string judged = "\"judged\":true";
    ASSERT_NE(other.find(judged), std::string::npos);
    testing_films::write_bytes(
        file, other.replace(other.find(judged), judged.size(), "\"judged\":false"));
    EXPECT_NE(logged("--scenes 4").out, whole.out);
}

TEST(Stress, OnlyALogOfTheSameRunGoesOn) {
    const testing_films::TemporaryFolder folder;
    const std::string file = (folder / "log").string();
    const auto logged = [&](const std::string& options) {
        return run_stress("--lists 0 --scenes 1 " + options + " --log " + file).code;
    };
    EXPECT_EQ(logged("--seed 2 --look-ups 1e5"), 0);
    const std::string log = read_whole_file(file);
    EXPECT_EQ(logged("--seed 3 --look-ups 1e5"), 3);
    EXPECT_EQ(logged("--seed 2 --look-ups 2e5"), 3);
    EXPECT_EQ(read_whole_file(file), log);
    for (const char* letter :
         {"a letter\n", "a letter\nto someone\n", "one without an end", "[]\n"}) {
        testing_films::write_bytes(file, letter);
        EXPECT_EQ(logged("--seed 2 --look-ups 1e5"), 3) << letter;
        EXPECT_EQ(read_whole_file(file), letter);
    }
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
    EXPECT_EQ(scene["materials"]["stress"]["relief"]["trace"], "steep-maxmip");
}

TEST(Stress, NonsenseIsRefused) {
    for (const char* arguments :
         {"--only nonsense", "--only 12x", "--scenes -1", "--processes 0", "--seconds 0",
          "--seconds nan", "--lists -1", "--nonsense", "extra", "--plot p.svg", "-o folder",
          "--list --planted", "--only 12 --ranges frame", "--look-ups 0", "--look-ups many",
          "--planted --log log"})
        EXPECT_EQ(run_stress(arguments).code, 2) << arguments;
    const testing_films::TemporaryFolder folder;
    testing_films::write_bytes(folder / "file", "x");
    EXPECT_EQ(run_stress("--only 12 -o " + (folder / "file").string()).code, 5);
}

}  // namespace
}  // namespace quadrel::tools_tests
