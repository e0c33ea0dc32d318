// Man pages: whole, and clean for those who format them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

#include "cli/shell/shells.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

class Manual : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(run({"man", "-o", folder.path().string()}).code, 0);
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
            if (entry.is_regular_file()) pages.push_back(entry.path());
        ASSERT_GT(pages.size(), 15u);
    }
    TemporaryFolder folder;
    std::vector<std::filesystem::path> pages;
};

/// What a formatter complains of; `line` reads the page as $PAGE.
std::string complaints(const std::string& line, const std::filesystem::path& page) {
    return output_of("PAGE='" + page.string() + "'; " + line);
}

constexpr const char* by_groff = "groff -man -ww -z -b -Tutf8 \"$PAGE\"";
// A page has no date: equal programs make equal pages.
constexpr const char* by_mandoc =
    "mandoc -Tlint -W warning \"$PAGE\" | grep -v 'missing date\\|lower case character'";

TEST_F(Manual, GroffHasNothingToSay) {
    if (!is_installed("groff")) GTEST_SKIP() << "groff is not installed";
    for (const auto& page : pages) EXPECT_EQ(complaints(by_groff, page), "") << page;
    testing_films::write_bytes(folder / "bad.1", ".TH A 1\n.SH \\*[none]\n");
    EXPECT_NE(complaints(by_groff, folder / "bad.1"), "");
}

TEST_F(Manual, MandocHasNothingToSay) {
    if (!is_installed("mandoc")) GTEST_SKIP() << "mandoc is not installed";
    for (const auto& page : pages) EXPECT_EQ(complaints(by_mandoc, page), "") << page;
    testing_films::write_bytes(folder / "bad.1", ".TH A 1\n.SH B\n.fi\n.XY\n");
    EXPECT_NE(complaints(by_mandoc, folder / "bad.1"), "");
}

/// A page as a reader sees it, without what makes letters bold.
std::string as_read(const std::filesystem::path& page) {
    return output_of("groff -man -Tascii -P-c -P-b -P-u -rLL=2000n '" + page.string() + "'");
}

TEST_F(Manual, EachVerbsOptionsAndExamplesAreThere) {
    if (!is_installed("groff")) GTEST_SKIP() << "groff is not installed";
    for (const char* verb : {"render", "compare", "bake", "list", "export", "join"}) {
        const std::string page = as_read(folder / "man1" / ("quadrel-" + std::string(verb) + ".1"));
        const std::string help = run({verb, "--help"}).out;
        static const std::regex option("\n  (-[^ ]+)");
        for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it)
            EXPECT_NE(page.find((*it)[1].str().substr(0, (*it)[1].str().find_first_of(",{"))),
                      std::string::npos)
                << verb << " " << (*it)[1];
        EXPECT_NE(page.find("quadrel " + std::string(verb) + " "), std::string::npos);
        EXPECT_NE(page.find("EXIT STATUS"), std::string::npos) << page;
    }
    const std::string scene = as_read(folder / "man5" / "quadrel-scene.5");
    for (const char* const key : {"fov_y", "grazing_fade", "direction_to_light"})
        EXPECT_NE(scene.find(key), std::string::npos) << key;
    const std::string channels = as_read(folder / "man7" / "quadrel-channels.7");
    EXPECT_NE(channels.find("hit.status"), std::string::npos);
}

TEST_F(Manual, APageIsPrintedByTheNameOfItsVerb) {
    EXPECT_EQ(run({"man"}).out, file_bytes(folder / "man1" / "quadrel.1"));
    EXPECT_EQ(run({"man", "render"}).out, file_bytes(folder / "man1" / "quadrel-render.1"));
    EXPECT_EQ(run({"man", "scene"}).out, file_bytes(folder / "man5" / "quadrel-scene.5"));
    const Outcome outcome = run({"man", "rendr"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("\"quadrel-render\""), std::string::npos) << outcome.err;
    testing_films::write_bytes(folder / "file", "");
    EXPECT_EQ(run({"man", "-o", (folder / "file").string()}).code, 5);
}

/// "| `NO_COLOR` | no colours ... |" by name.
std::map<std::string, std::string> variables_in_readme() {
    std::ifstream stream(QUADREL_SOURCE_DIR "/README.md");
    std::map<std::string, std::string> variables;
    bool inside = false;
    for (std::string line; std::getline(stream, line);) {
        if (line == "| variable | means |") inside = true;
        if (line.empty()) inside = false;
        static const std::regex row("\\| `([A-Z_]+)` \\| (.*) \\|");
        std::smatch match;
        if (inside && std::regex_match(line, match, row)) variables[match[1]] = match[2];
    }
    return variables;
}

TEST_F(Manual, EnvironmentIsThatOfTheReadme) {
    if (!is_installed("groff")) GTEST_SKIP() << "groff is not installed";
    const auto variables = variables_in_readme();
    EXPECT_EQ(variables.size(), 4u);
    const std::string page = as_read(folder / "man1" / "quadrel.1");
    for (auto [name, meaning] : variables) {
        std::erase(meaning, '`');
        EXPECT_NE(page.find(name), std::string::npos) << name;
        EXPECT_NE(page.find(meaning), std::string::npos) << page;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
