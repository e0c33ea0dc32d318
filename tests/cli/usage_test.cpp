// Parsing, exit codes, error messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;

/// The exit code, nothing on standard output, and one line "quadrel: ..." on standard error.
AssertionResult complains(const Outcome& outcome, int code) {
    if (outcome.code != code) return AssertionFailure() << "code " << outcome.code << outcome.err;
    if (!outcome.out.empty()) return AssertionFailure() << "printed: " << outcome.out;
    if (outcome.err.compare(0, 9, "quadrel: ") != 0 ||
        std::count(outcome.err.begin(), outcome.err.end(), '\n') != 1 || outcome.err.back() != '\n')
        return AssertionFailure() << "message: " << outcome.err;
    return AssertionSuccess();
}

TEST(Complaint, TheCheckItselfFails) {
    EXPECT_TRUE(complains({2, "", "quadrel: bad\n"}, 2));
    EXPECT_FALSE(complains({3, "", "quadrel: bad\n"}, 2));
    EXPECT_FALSE(complains({2, "x", "quadrel: bad\n"}, 2));
    EXPECT_FALSE(complains({2, "", "bad\n"}, 2));
    EXPECT_FALSE(complains({2, "", "quadrel: bad\nworse\n"}, 2));
    EXPECT_FALSE(complains({2, "", ""}, 2));
}

TEST(Usage, HelpAndVersion) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"render", "--help"},
                                                      {"compare", "-h"},
                                                      {"--version"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_NE(outcome.out.find("quadrel"), std::string::npos);
        EXPECT_EQ(outcome.err, "");
    }
}

TEST(Usage, CommandLinesThatMakeNoSense) {
    const std::vector<std::vector<std::string>> lines = {
        {},
        {"paint"},
        {"render"},
        {"render", "a", "b"},
        {"render", "a", "--nonsense"},
        {"render", "a", "--number", "half"},
        {"render", "a", "--isa", "mmx"},
        {"render", "a", "--compression", "lzw"},
        {"render", "a", "--compression", ""},
        {"mips", "a.png", "-o", "a", "--compression", "dwaa"},
        {"bake", "a.png", "--kind", "cone-cell", "--compression", "ZIP"},
        {"render", "a", "-t", "-1"},
        {"render", "a", "-t", "many"},
        {"render", "a", "--tile", "0"},
        {"render", "a", "--channels", "R,,G"},
        {"render", "a", "--channels", "colour"},
        {"render", "a", "--window", "0,0,5"},
        {"render", "a", "--window", "0,0,0,5"},
        {"render", "a", "--window", "-1,0,4,5"},
        {"render", "a", "--window", "0,0,4,5x"},
        {"render", "thesis-quad", "--integrate", "many"},
        {"render", "thesis-quad", "--integrate", "17"},
        {"render", "thesis-quad", "--integrate", "-16"},
        {"render", "thesis-quad", "--integrate", "131072"},
        {"render", "thesis-quad", "--integrate-error", "0"},
        {"render", "thesis-quad", "--integrate-error", "nan"},
        {"render", "thesis-quad", "--integrate", "16", "--channels", "Z"},
        {"render", "thesis-quad", "--channels", "integral.samples"},
        {"compare", "a.exr"},
        {"compare", "a.exr", "b.exr", "--abs", "-1"},
        {"list"},
        {"list", "colours"},
        {"info"},
    };
    for (const auto& line : lines) {
        std::string text;
        for (const std::string& word : line) text += " " + word;
        EXPECT_TRUE(complains(run(line), 2)) << text;
    }
}

TEST(Usage, UnknownChannelNamesTheNearest) {
    const Outcome outcome = run({"render", "a", "--channels", "hit.stats"});
    EXPECT_NE(outcome.err.find("\"hit.status\""), std::string::npos) << outcome.err;
}

TEST(Usage, UnknownCompressionNamesTheNearest) {
    const Outcome outcome = run({"render", "a", "--compression", "sip"});
    EXPECT_NE(outcome.err.find("\"zip\", or one of none, rle, zips, zip, piz"), std::string::npos)
        << outcome.err;
}

TEST(Input, MissingAndBadFiles) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "bad.exr", "no image at all, none");
    testing_films::write_bytes(folder / "bad.json", "{\"quadrel\": 1, ");
    for (const std::vector<std::string>& line :
         std::vector<std::vector<std::string>>{{"compare", "missing.exr", "missing.exr"},
                                               {"compare", "bad.exr", "bad.exr"},
                                               {"info", "missing.exr"},
                                               {"info", "missing.json"},
                                               {"info", "bad.json"},
                                               {"render", "missing.json"},
                                               {"render", "bad.json"},
                                               {"render", "no-such-scene"}})
        EXPECT_TRUE(complains(run(line, folder.path()), 3)) << line[0] << " " << line[1];
}

TEST(List, EveryListInBothForms) {
    for (const char* kind : {"algorithms", "channels", "presets", "scenes"}) {
        const Outcome text = run({"list", kind});
        EXPECT_EQ(text.code, 0);
        EXPECT_EQ(text.err, "");
        const Outcome json = run({"list", kind, "--json"});
        EXPECT_EQ(json.code, 0);
        EXPECT_TRUE(nlohmann::json::parse(json.out).is_array()) << kind;
    }
    EXPECT_NE(run({"list", "channels"}).out.find("uv.U"), std::string::npos);
}

TEST(List, FullStandardOutputIsAnError) {
    EXPECT_TRUE(complains(run({"list", "channels"}, "/", "/dev/full"), 5));
    EXPECT_TRUE(complains(run({"--help"}, "/", "/dev/full"), 5));
}

/// Processor time of all children so far, which other load on the machine changes little.
double seconds_of_children() {
    rusage usage = {};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

TEST(List, IsQuick) {
    const double begin = seconds_of_children();
    for (int i = 0; i < 20; ++i) EXPECT_EQ(run({"list", "channels"}).code, 0);
#ifdef NDEBUG
    EXPECT_LT((seconds_of_children() - begin) / 20, 0.1)
        << "loading an image library takes twice as long";
#else
    EXPECT_GT(seconds_of_children(), begin);
#endif
}

}  // namespace
}  // namespace quadrel::cli_tests
