// quadrel-conformance --resume: what a file has already is not judged again.
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

TEST(ConformanceProgram, GoesOnFromItsOutput) {
    const testing_films::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "all.json";
    const auto judge = [&](const std::string& angles, int size) {
        return run_command(std::string("ASAN_OPTIONS=detect_leaks=0 " QUADREL_CONFORMANCE) +
                           " linear --llvmpipe --maps obstacles --most-ranged 1 --quiet --resume "
                           "--angles " +
                           angles + " --size " + std::to_string(size) + " -o '" + file.string() +
                           "' 2>&1");
    };
    const Outcome first = judge("45", 24);
    if (first.code == 3) GTEST_SKIP() << "skipped: " << first.out;
    ASSERT_EQ(first.code, 0) << first.out;
    nlohmann::ordered_json known = read_json(file);
    ASSERT_EQ(known["cases"].size(), 1u);
    known["cases"][0]["groups"]["uv"]["same"] = 12345;
    std::ofstream(file) << known;

    EXPECT_EQ(judge("45,60", 24).code, 0);
    const nlohmann::ordered_json both = read_json(file);
    ASSERT_EQ(both["cases"].size(), 2u);
    EXPECT_EQ(both["cases"][0], known["cases"][0]);
    EXPECT_EQ(both["cases"][1]["groups"]["uv"]["same"], 24 * 24);

    const Outcome other = judge("45", 32);
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.out.find("size 24"), std::string::npos) << other.out;
    EXPECT_EQ(read_json(file), both);
    std::ofstream(file) << "{}";
    EXPECT_EQ(judge("45", 24).code, 3);
}

}  // namespace
}  // namespace quadrel::tools_tests
