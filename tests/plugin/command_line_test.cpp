// --plugin: what a user sees.
#include "built_isas.hpp"
#include "cli/process.hpp"
#include "plugin/support.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::plugin_tests {
namespace {

using cli_tests::Outcome;
using cli_tests::run;

const std::vector<std::string> own_stages = {
    "-D", "material.relief.trace=test-waves",  "-D", "material.relief.steps=9",
    "-D", "material.relief.surface=test-tilt", "-D", "material.shade=test-stripes"};

class CommandLine : public testing::Test {
  protected:
    /// Renders bricks-45 with the stages of the plugin in `file` into `out`.
    Outcome render(const std::filesystem::path& file, const std::string& out,
                   const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = {
            "render",      "bricks-45",  "--size",  "40x32", "--plugin",
            file.string(), "--channels", "R,hit,N", "-o",    out};
        arguments.insert(arguments.end(), own_stages.begin(), own_stages.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, folder.path());
    }
    Film film(const std::string& name) { return read_exr(folder / name).film; }

    /// The first lane set beside scalar, or "" if there is none.
    static std::string lane_set() {
        const std::string first = built_isas().front();
        return first == "scalar" ? "" : first;
    }

    const std::filesystem::path stages = plugin("quadrel-test-stages");
    testing_films::TemporaryFolder folder;
};

/// Exit code, and one line on standard error that holds `part`.
testing::AssertionResult fails(const Outcome& outcome, int code, const std::string& part) {
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    if (outcome.code == code && lines == 1 && outcome.err.find(part) != std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << outcome.code << ": " << outcome.err;
}

TEST_F(CommandLine, RendersWithTheSameBitsOnEveryInstructionSet) {
    ASSERT_EQ(render(stages, "auto.exr").code, 0);
    for (const std::string& isa : built_isas()) {
        ASSERT_EQ(render(stages, isa + ".exr", {"--isa", isa}).code, 0);
        EXPECT_TRUE(same_bits(film("auto.exr"), film(isa + ".exr"))) << isa;
    }
    ASSERT_EQ(render(stages, "other.exr", {"-D", "material.relief.steps=8"}).code, 0);
    EXPECT_FALSE(same_bits(film("auto.exr"), film("other.exr")));
}

/// What README.md says to run, but smaller; its stage takes the place of the scene's own.
TEST_F(CommandLine, RunsTheExampleOfTheReadme) {
    const auto bricks = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render",     "bricks-45",   "--size", "40x32",
                                              "--channels", "R,G,B,hit,N", "-o",     out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments, folder.path());
    };
    const std::string readme = plugin("quadrel-test-readme").string();
    ASSERT_EQ(bricks("linear.exr", {}).code, 0);
    const Outcome own =
        bricks("own.exr", {"--plugin", readme, "-D", "material.relief.trace=my-steep"});
    ASSERT_EQ(own.code, 0) << own.err;
    EXPECT_TRUE(same_bits(film("linear.exr"), film("own.exr")));
    ASSERT_EQ(bricks("more.exr", {"--plugin", readme, "-D", "material.relief.trace=my-steep", "-D",
                                  "material.relief.steps=512"})
                  .code,
              0);
    EXPECT_FALSE(same_bits(film("linear.exr"), film("more.exr")));
}

/// The stages' ids alone would not say what they did.
TEST_F(CommandLine, ImagesNameThePlugin) {
    ASSERT_EQ(render(stages, "a.exr").code, 0);
    const std::string named = read_exr(folder / "a.exr").attributes.at("quadrel:plugins");
    EXPECT_EQ(named.find("quadrel-test-stages.so "), 0u) << named;
    EXPECT_EQ(named.size(), std::string("quadrel-test-stages.so ").size() + 64);
    ASSERT_EQ(run({"render", "bricks-45", "--size", "8x8", "-o", "b.exr"}, folder.path()).code, 0);
    EXPECT_EQ(read_exr(folder / "b.exr").attributes.count("quadrel:plugins"), 0u);
}

TEST_F(CommandLine, StagesAreUnknownWithoutThePlugin) {
    std::vector<std::string> arguments = {"render", "bricks-45"};
    arguments.insert(arguments.end(), own_stages.begin(), own_stages.end());
    EXPECT_TRUE(fails(run(arguments, folder.path()), 3, "unknown stage \"test-waves\""));
}

TEST_F(CommandLine, ListsStages) {
    const Outcome with = run({"list", "algorithms", "--plugin", stages.string()});
    EXPECT_EQ(with.code, 0);
    EXPECT_NE(with.out.find("test-waves"), std::string::npos);
    EXPECT_NE(with.out.find("where the wave begins"), std::string::npos);
    EXPECT_NE(with.out.find(" not reproduced: ebb and flow\n"), std::string::npos);
    const Outcome json = run({"list", "algorithms", "--json", "--plugin", stages.string()});
    EXPECT_NE(json.out.find("\"id\": \"test-stripes\""), std::string::npos);
    EXPECT_NE(json.out.find("\"not_reproduced\": \"ebb and flow\""), std::string::npos);
    EXPECT_NE(json.out.find("\"not_reproduced\": \"\""), std::string::npos);
    EXPECT_EQ(run({"list", "algorithms"}).out.find("test-waves"), std::string::npos);
}

TEST_F(CommandLine, ExplainsAndProbes) {
    const Outcome plan = render(stages, "none.exr", {"--explain"});
    EXPECT_EQ(plan.code, 0);
    EXPECT_NE(plan.out.find("runs test-tilt"), std::string::npos) << plan.out;
    std::vector<std::string> arguments = {"probe",   "bricks-45", "--pixel",
                                          "256,256", "--plugin",  stages.string()};
    arguments.insert(arguments.end(), own_stages.begin(), own_stages.end());
    const Outcome probed = run(arguments);
    EXPECT_EQ(probed.code, 0) << probed.err;
    EXPECT_NE(probed.out.find("test-waves"), std::string::npos);
}

TEST_F(CommandLine, BlameNamesThePlugin) {
    ASSERT_EQ(render(stages, "a.exr").code, 0);
    ASSERT_EQ(render(stages, "b.exr", {"-D", "material.relief.steps=3"}).code, 0);
    std::vector<std::string> arguments = {"compare",   "a.exr",    "b.exr",        "--blame",
                                          "bricks-45", "--plugin", stages.string()};
    arguments.insert(arguments.end(), own_stages.begin(), own_stages.end());
    const Outcome blamed = run(arguments, folder.path());
    EXPECT_EQ(blamed.code, 1) << blamed.err;
    EXPECT_NE(blamed.out.find("--plugin " + stages.string()), std::string::npos) << blamed.out;
    EXPECT_TRUE(
        fails(run({"compare", "a.exr", "b.exr", "--plugin", stages.string()}, folder.path()), 2,
              "--blame"));
}

// ---- What is refused ----------------------------------------------------------------------------

TEST_F(CommandLine, RefusesWhatIsNoPlugin) {
    EXPECT_TRUE(fails(render(plugin("quadrel-test-old"), "a.exr"), 3, "another version"));
    EXPECT_TRUE(fails(render(plugin("quadrel-test-clash"), "a.exr"), 3, "\"linear\""));
    EXPECT_TRUE(fails(render(folder / "missing.so", "a.exr"), 3, "no such file"));
    EXPECT_EQ(folder.count(), 0u);
}

/// Asked for by name, a set must be there; left to itself, a render does without it.
TEST_F(CommandLine, PartsForInstructionSetsMayBeMissing) {
    const std::string isa = lane_set();
    if (isa.empty()) GTEST_SKIP() << "plain lanes only";
    std::filesystem::copy_file(stages, folder / "alone.so");
    EXPECT_TRUE(
        fails(render(folder / "alone.so", "a.exr", {"--isa", isa}), 2, "alone-" + isa + ".so"));
    ASSERT_EQ(render(folder / "alone.so", "alone.exr").code, 0);
    ASSERT_EQ(render(stages, "whole.exr").code, 0);
    EXPECT_TRUE(same_bits(film("whole.exr"), film("alone.exr")));
}

TEST_F(CommandLine, PartsMustBeOfTheSamePlugin) {
    const std::string isa = lane_set();
    if (isa.empty()) GTEST_SKIP() << "plain lanes only";
    std::filesystem::copy_file(stages, folder / "mixed.so");
    std::filesystem::copy_file(plugin("quadrel-test-readme-" + isa),
                               folder / ("mixed-" + isa + ".so"));
    EXPECT_TRUE(fails(render(folder / "mixed.so", "a.exr", {"--isa", isa}), 3,
                      "test-waves: found no such stage"));
    std::filesystem::copy_file(stages, folder / ("mixed-" + isa + ".so"),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(fails(render(folder / "mixed.so", "a.exr", {"--isa", isa}), 3,
                      "found the scalar part of a plugin, expected its " + isa + " part"));
}

}  // namespace
}  // namespace quadrel::plugin_tests
