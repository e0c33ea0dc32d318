// quadrel-gl: what it says on bad command lines, its lists, and, where there is an implementation
// to ask, what it finds.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

/// Runs `quadrel-gl arguments`; both streams. What Mesa never frees is no concern of ours.
Outcome run_gl(const std::string& arguments) {
    return run_command("ASAN_OPTIONS=detect_leaks=0 " QUADREL_GL " " + arguments + " 2>&1");
}

TEST(Gl, SaysWhatIsWrongWithACommand) {
    EXPECT_EQ(run_gl("").code, 2);
    EXPECT_EQ(run_gl("--probe --expect nobody").code, 2);
    EXPECT_EQ(run_gl("--planted").code, 2);
    const Outcome unknown = run_gl("--probe --only derivative");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.out.find("no probe is called derivative"), std::string::npos);
    EXPECT_EQ(run_gl("--list -o /nowhere/list.txt").code, 5);
    EXPECT_EQ(run_gl("--list --info").code, 2);
}

/// An option that a task does not heed is a mistake; whatever it heeds it shows.
TEST(Gl, NoOptionIsPassedOver) {
    for (const char* command :
         {"--list --wide", "--list --expect llvmpipe", "--list --llvmpipe", "--list --markdown",
          "--info --only quads", "--info --expect llvmpipe", "--info --markdown",
          "--planted --expect llvmpipe --only quads", "--probe --pass 1", "--list somewhere"}) {
        const Outcome outcome = run_gl(command);
        EXPECT_EQ(outcome.code, 2) << command << ": " << outcome.out;
    }
    const Outcome one = run_gl("--list --only gather --json");
    EXPECT_EQ(one.code, 0);
    const auto json = nlohmann::json::parse(one.out);
    ASSERT_EQ(json.size(), 1u);
    EXPECT_EQ(json[0]["id"], "gather");
}

/// What a preset does not model is neither agreement nor the contrary.
TEST(Gl, WhatIsNotModelledIsNotJudged) {
    const Outcome none = run_gl("--llvmpipe --probe --only min-nan --expect llvmpipe -o /dev/null");
    if (none.code == 3) GTEST_SKIP() << none.out;
    EXPECT_EQ(none.code, 2) << none.out;
    const Outcome one =
        run_gl("--llvmpipe --probe --only min-nan quads --expect llvmpipe -o /dev/null");
    EXPECT_EQ(one.code, 0) << one.out;
    EXPECT_NE(one.out.find("do not model it: min-nan"), std::string::npos) << one.out;
    EXPECT_NE(one.out.find("1 of 1 probes do as expected"), std::string::npos) << one.out;
}

TEST(Gl, ListsWhatIsAskedAndWhatIsPermitted) {
    const Outcome list = run_gl("--list");
    EXPECT_EQ(list.code, 0);
    for (const char* id : {"quads", "fill-fans", "lod-formula", "gather", "cube-corners", "fma"})
        EXPECT_NE(("\n" + list.out).find("\n" + std::string(id) + ": "), std::string::npos) << id;
}

TEST(Gl, AnswersComeAsJson) {
    const Outcome outcome = run_gl("--llvmpipe --probe --json --only derivatives quad-lod min-nan");
    if (outcome.code == 3) GTEST_SKIP() << outcome.out;
    ASSERT_EQ(outcome.code, 0) << outcome.out;
    const std::size_t begin = outcome.out.find('{'), end = outcome.out.rfind('}');  // Mesa may warn
    const auto json = nlohmann::json::parse(outcome.out.substr(begin, end + 1 - begin));
    EXPECT_NE(json["renderer"].get<std::string>().find("llvmpipe"), std::string::npos);
    ASSERT_EQ(json["probes"].size(), 3u);
    const auto& derivatives = json["probes"][0];
    EXPECT_EQ(derivatives["seen"], "fine");
    EXPECT_EQ(derivatives["permitted"], true);
    EXPECT_EQ(derivatives["presets"]["llvmpipe"]["agrees"], true);
    const auto& swiftshader = derivatives["presets"]["swiftshader"];
    EXPECT_EQ(swiftshader["does"], "coarse");
    EXPECT_EQ(swiftshader["agrees"], false);
    EXPECT_EQ(swiftshader["first"]["pixel"], 1);  // its dFdy is not that of column 0
}

TEST(Gl, APresetThatDoesOtherwiseIsNamed) {
    const Outcome outcome =
        run_gl("--llvmpipe --probe --only derivatives nearest-level --expect d3d -o /dev/null");
    if (outcome.code == 3) GTEST_SKIP() << outcome.out;
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("nearest-level: seen 0 2 2 4, expected 0 1 2 3"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(outcome.out.find("derivatives:"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::tools_tests
