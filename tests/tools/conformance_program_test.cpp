// quadrel-conformance: what a file has already is not judged again (--resume), and what it says
// when it fails.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "film/films.hpp"
#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return nlohmann::ordered_json::parse(stream);
}

Outcome judge(const std::string& arguments) {
    return run_command("ASAN_OPTIONS=detect_leaks=0 " QUADREL_CONFORMANCE
                       " --llvmpipe --maps obstacles --angles 45 --size 24 --quiet " +
                       arguments + " 2>&1");
}

/// A bound that is left is named, with what was found; so is that nothing was judged.
TEST(ConformanceProgram, SaysWhyItFails) {
    const Outcome fine = judge("linear --most-ranged 0");
    if (fine.code == 3) GTEST_SKIP() << "skipped: " << fine.out;
    EXPECT_EQ(fine.code, 0) << fine.out;
    const Outcome left = judge("linear --hardware exact --most-ranged 0 --most-perturbed 0");
    EXPECT_EQ(left.code, 1);
    EXPECT_NE(left.out.find("quadrel-conformance: linear obstacles 45 degrees: found "),
              std::string::npos)
        << left.out;
    const Outcome nothing = judge("oracle-bilinear");
    EXPECT_EQ(nothing.code, 1);
    EXPECT_NE(nothing.out.find("no row could be drawn, and nothing judged"), std::string::npos)
        << nothing.out;
}

TEST(ConformanceProgram, GoesOnFromItsOutput) {
    const testing_films::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "all.json";
    const auto judge_at = [&](const std::string& angles, int size) {
        return run_command(std::string("ASAN_OPTIONS=detect_leaks=0 " QUADREL_CONFORMANCE) +
                           " linear --llvmpipe --maps obstacles --most-ranged 1 --quiet --resume "
                           "--angles " +
                           angles + " --size " + std::to_string(size) + " -o '" + file.string() +
                           "' 2>&1");
    };
    const Outcome first = judge_at("45", 24);
    if (first.code == 3) GTEST_SKIP() << "skipped: " << first.out;
    ASSERT_EQ(first.code, 0) << first.out;
    nlohmann::ordered_json known = read_json(file);
    ASSERT_EQ(known["cases"].size(), 1u);
    known["cases"][0]["groups"]["uv"]["same"] = 12345;
    std::ofstream(file) << known;

    EXPECT_EQ(judge_at("45,60", 24).code, 0);
    const nlohmann::ordered_json both = read_json(file);
    ASSERT_EQ(both["cases"].size(), 2u);
    EXPECT_EQ(both["cases"][0], known["cases"][0]);
    EXPECT_EQ(both["cases"][1]["groups"]["uv"]["same"], 24 * 24);

    const Outcome other = judge_at("45", 32);
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.out.find("size 24"), std::string::npos) << other.out;
    EXPECT_EQ(read_json(file), both);
    std::ofstream(file) << "{}";
    EXPECT_EQ(judge_at("45", 24).code, 3);
}

}  // namespace
}  // namespace quadrel::tools_tests
