// Help where a command line went wrong: the nearest verb, whose help to read, examples that work.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;
using Words = std::vector<std::string>;

constexpr const char* verbs[] = {"render", "compare", "list", "info",  "explain",   "probe",
                                 "sheet",  "mips",    "bake", "sweep", "advise",    "errors",
                                 "export", "view",    "join", "man",   "completion"};

Words split(const std::string& line) {
    std::istringstream stream(line);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// The command lines below "Examples:", without the program's name.
std::vector<Words> examples_in(const std::string& help) {
    std::vector<Words> examples;
    std::istringstream lines(help.substr(std::min(help.find("Examples:"), help.size())));
    for (std::string line; std::getline(lines, line);) {
        Words words = split(line);
        if (words.empty() || words[0] != "quadrel") continue;
        words.erase(words.begin());
        examples.push_back(words);
    }
    return examples;
}

/// Puts `value` behind `option` where there is such an option; whether there is.
bool set_option(Words& words, const std::string& option, const std::string& value) {
    const auto found = std::find(words.begin(), words.end(), option);
    if (found == words.end()) return false;
    *(found + 1) = value;
    return true;
}

/// A command line that makes sense, whatever became of it where its files are missing. Of few
/// pixels and samples: what they look like is not the question.
AssertionResult makes_sense(Words words) {
    const TemporaryFolder folder;
    const bool draws = words[0] == "render" || words[0] == "sheet";
    if (!set_option(words, "--size", "8x8") && draws) words.insert(words.end(), {"--size", "8x8"});
    set_option(words, "--window", "0,0,8,8");
    set_option(words, "--integrate", "16");
    set_option(words, "--task", "1/1");
    const Outcome outcome = run(words, folder.path());
    if (outcome.code == 0 || outcome.code == 3) return AssertionSuccess();
    return AssertionFailure() << outcome.code << " " << outcome.err;
}

TEST(Help, EachVerbHasTwoExamplesThatMakeSense) {
    for (const char* verb : verbs) {
        const std::vector<Words> examples = examples_in(run({verb, "--help"}).out);
        EXPECT_GE(examples.size(), 2u) << verb;
        for (const Words& example : examples) {
            EXPECT_EQ(example[0], verb);
            EXPECT_TRUE(makes_sense(example)) << verb;
        }
    }
    EXPECT_FALSE(makes_sense({"list", "algorithmes"}));
    EXPECT_FALSE(makes_sense({"render", "bricks-45", "--chanels", "R"}));
}

/// Exit code 2 and a message with each of `parts`.
AssertionResult refuses(const Words& words, const Words& parts) {
    const Outcome outcome = run(words);
    if (outcome.code != 2) return AssertionFailure() << "code " << outcome.code;
    for (const std::string& part : parts)
        if (outcome.err.find(part) == std::string::npos) return AssertionFailure() << outcome.err;
    return AssertionSuccess();
}

TEST(Help, MistypedWordsGetTheNearest) {
    EXPECT_TRUE(refuses({"rendr", "bricks-45"}, {"\"rendr\"", "\"render\"", "`quadrel --help`"}));
    EXPECT_TRUE(refuses({"xyzzy"}, {"\"xyzzy\"", "one of render", "`quadrel --help`"}));
    EXPECT_TRUE(refuses({"list", "chanels"}, {"\"channels\"", "`quadrel list --help`"}));
    EXPECT_TRUE(refuses({"render", "a", "--chanels", "R"}, {"expected \"--channels\""}));
    EXPECT_TRUE(refuses({"explain", "camera.fov"}, {"camera.fov", "`quadrel explain --help`"}));
    EXPECT_TRUE(refuses({"explain", "hit.stats"}, {"\"hit.status\""}));
    EXPECT_TRUE(refuses({"explain", "mateial.reliev"}, {"\"material.relief\""}));
    EXPECT_TRUE(refuses({"explain", "linaer"}, {"\"linear\""}));
}

TEST(Help, OnlyNearWordsAreSuggested) {
    const auto suggests = [](const Words& words) {
        return run(words).err.find("did you mean") != std::string::npos ||
               run(words).err.find(", or one of") != std::string::npos;
    };
    EXPECT_TRUE(suggests({"explain", "hit.stats"}));
    for (const Words& words : std::vector<Words>{{"explain", "99"},
                                                 {"explain", "xyzzy"},
                                                 {"explain", "K9"},
                                                 {"paint"},
                                                 {"render", "a", "--xyzzy"},
                                                 {"render", "a", "-x"}})
        EXPECT_FALSE(suggests(words)) << run(words).err;
    EXPECT_TRUE(refuses({"explain", "relief.depth.thickness"}, {"mean \"relief.depth\"?"}));
}

TEST(Help, MistypedOptionsReadLikeMistypedVerbs) {
    EXPECT_TRUE(refuses({"render", "a", "--chanels", "R"},
                        {"found \"--chanels\", expected \"--channels\", or one of --help"}));
    EXPECT_TRUE(refuses({"render", "--chanels=R"}, {"found \"--chanels\", expected"}));
    EXPECT_TRUE(refuses({"render", "a", "-x"}, {"found \"-x\", expected one of"}));
    EXPECT_TRUE(refuses({"--versoin"}, {"found \"--versoin\", expected \"--version\""}));
    EXPECT_TRUE(refuses({"render", "--version"}, {"expected `quadrel --version`"}));
    EXPECT_TRUE(refuses({"render", "a", "b"}, {"found \"b\", expected no more"}));
    EXPECT_TRUE(refuses({"list"}, {"found nothing after \"quadrel list\"", "one of algorithms"}));
}

TEST(Help, HelpAndVersionAsWords) {
    for (const auto& [words, same] : std::vector<std::pair<Words, Words>>{
             {{"help"}, {"--help"}},
             {{"help", "render"}, {"render", "--help"}},
             {{"help", "list", "scenes"}, {"list", "scenes", "--help"}},
             {{"version"}, {"--version"}},
             {{"-V"}, {"--version"}}}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << words[0];
        EXPECT_EQ(outcome.out, run(same).out);
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_TRUE(refuses({"help", "rendr"}, {"\"render\""}));
    EXPECT_TRUE(refuses({"rendr", "--help"}, {"\"render\""}));
}

TEST(Help, UsageErrorsNameTheVerbsOwn) {
    for (const Words& words : std::vector<Words>{{"render"},
                                                 {"render", "a", "--nonsense"},
                                                 {"render", "a", "-t", "many"},
                                                 {"render", "a", "--size", "3"},
                                                 {"compare", "a.exr"},
                                                 {"compare", "a", "b", "--abs", "-1"},
                                                 {"probe", "a", "--pixel", "x"},
                                                 {"list"},
                                                 {"info"},
                                                 {"bake", "a", "--kind", "cone", "--param", "x"}})
        EXPECT_TRUE(refuses(words, {"(see `quadrel " + words[0] + " --help`)"})) << words[0];
    // One that names another place to look at keeps to that.
    EXPECT_TRUE(refuses({"render", "a", "--channels", "hit.stats"}, {"`quadrel list channels`)"}));
}

// ---- Exit codes ---------------------------------------------------------------------------------

/// "| 2 | bad command line |" by code.
std::map<std::string, std::string> codes_in_readme(const std::string& file) {
    std::ifstream stream(file);
    std::map<std::string, std::string> codes;
    bool inside = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("| exit code", 0) == 0) inside = true;
        if (line.empty()) inside = false;
        const std::size_t second = line.find(" | ");
        if (!inside || second == std::string::npos || line.size() < 4) continue;
        if (line[2] < '0' || line[2] > '9') continue;
        codes[line.substr(2, second - 2)] = line.substr(second + 3, line.size() - second - 5);
    }
    return codes;
}

std::string plain(std::string text) {
    std::erase(text, '`');
    return text;
}

TEST(Help, ExitCodesAreThoseOfTheReadme) {
    const auto codes = codes_in_readme(QUADREL_DATA_DIR "/../README.md");
    EXPECT_EQ(codes.size(), 10u);
    const std::string help = run({"--help"}).out;
    for (const auto& [code, meaning] : codes) {
        const Outcome outcome = run({"explain", code});
        EXPECT_EQ(outcome.out, code + ": exit code\n  " + plain(meaning) + "\n");
        EXPECT_NE(help.find(plain(meaning)), std::string::npos) << code;
    }
    EXPECT_EQ(run({"explain", "17"}).code, 2);
}

}  // namespace
}  // namespace quadrel::cli_tests
