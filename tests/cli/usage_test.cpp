// Parsing, exit codes, error messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "file/read_file.hpp"
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

/// The option, what it was given, and what it takes.
AssertionResult says_found_and_expected(std::vector<std::string> line, const std::string& option,
                                        const std::string& found, const std::string& expected) {
    line.insert(line.begin(), {"render", "a"});
    const Outcome outcome = run(line);
    if (auto one = complains(outcome, 2); !one) return one;
    const std::string text = option + ": found \"" + found + "\", expected " + expected;
    return outcome.err.find(text) != std::string::npos ? AssertionSuccess()
                                                       : AssertionFailure() << outcome.err;
}

TEST(Usage, OptionsSayWhatIsFoundAndExpected) {
    const std::string tile = "an integer, 2 to 1024", threads = "an integer, 0 to 1024";
    EXPECT_TRUE(says_found_and_expected({"--tile", "1"}, "--tile", "1", tile));
    EXPECT_TRUE(says_found_and_expected({"--tile", "2x"}, "--tile", "2x", tile));
    EXPECT_TRUE(says_found_and_expected({"-t", "-1"}, "--threads", "-1", threads));
    EXPECT_TRUE(says_found_and_expected({"-t", "many"}, "--threads", "many", threads));
    EXPECT_TRUE(
        says_found_and_expected({"--number", "half"}, "--number", "half", "one of float, double"));
    EXPECT_TRUE(says_found_and_expected({"--number", "flaot"}, "--number", "flaot", "\"float\""));
    EXPECT_FALSE(says_found_and_expected({"--tile", "64"}, "--tile", "64", tile));
}

/// Blanks around numbers are left out, within a number they are a mistake.
TEST(Usage, BlanksWithinNumbersAreNoNumbers) {
    for (const char* size : {"1 2x3", "12x3 4", "1 x 2 3"})
        EXPECT_TRUE(says_found_and_expected({"--size", size}, "--size", size, "WIDTHxHEIGHT"));
    EXPECT_TRUE(says_found_and_expected({"--window", "0,0,1 0,5"}, "--window", "0,0,1 0,5", "x0"));
    EXPECT_FALSE(says_found_and_expected({"--size", " 12 x 3 "}, "--size", " 12 x 3 ", "WIDTH"));
}

TEST(Usage, APlaceholderIsNoChannel) {
    const Outcome outcome = run({"render", "a", "--channels", "shadow.<i>.steps"});
    EXPECT_NE(outcome.err.find("did you mean \"shadow.0.steps\""), std::string::npos)
        << outcome.err;
}

TEST(Usage, HelpOfHelpIsHelp) {
    EXPECT_EQ(run({"help", "help"}).out, run({"--help"}).out);
    EXPECT_EQ(run({"help", "help", "render"}).out, run({"render", "--help"}).out);
    EXPECT_NE(run({"render", "--help"}).out.find("double runs on scalar alone"), std::string::npos);
}

TEST(Usage, UnknownCompressionNamesTheNearest) {
    const Outcome outcome = run({"render", "a", "--compression", "sip"});
    EXPECT_NE(outcome.err.find("\"zip\", or one of none, rle, zips, zip, piz"), std::string::npos)
        << outcome.err;
}

/// Where one may not look, one does not know that nothing is there.
TEST(Input, AFileInAClosedFolderIsNotMissing) {
    const TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    std::filesystem::create_directory(folder / "closed");
    testing_films::write_bytes(folder / "closed" / "a.exr", "image");
    std::filesystem::permissions(folder / "closed", std::filesystem::perms::none);
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t nobody = 65534;
        if (getuid() == 0 && setuid(nobody) != 0) _exit(0);
        const char* const reason = reason_not_to_read(folder / "closed" / "a.exr");
        _exit(reason != nullptr && std::string(reason).find("no permission") == 0 ? 0 : 1);
    }
    EXPECT_EQ(wait_for(child), 0);
    std::filesystem::permissions(folder / "closed", std::filesystem::perms::all);
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
