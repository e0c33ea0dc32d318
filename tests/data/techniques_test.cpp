// data/README.md, document by document: every row of `list algorithms` stands in it, every row that
// stands in it exists, and a technique without rows says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "quadrel/relief/registry.hpp"

namespace quadrel::test {
namespace {

struct Technique {
    std::string name, remark;
    std::vector<std::string> rows;
};

std::string readme_text() {
    std::ifstream in(std::filesystem::path(QUADREL_DATA_DIR) / "README.md");
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// What stands between backticks.
std::vector<std::string> quoted_words(const std::string& cell) {
    std::vector<std::string> words;
    std::size_t from = 0;
    while ((from = cell.find('`', from)) != std::string::npos) {
        const std::size_t end = cell.find('`', from + 1);
        if (end == std::string::npos) break;
        words.push_back(cell.substr(from + 1, end - from - 1));
        from = end + 1;
    }
    return words;
}

/// The lines of all tables but their heads.
std::vector<Technique> techniques_of(const std::string& text) {
    std::vector<Technique> techniques;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ") || line.starts_with("| technique |")) continue;
        std::vector<std::string> cells;
        std::istringstream parts(line.substr(1));
        for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
        if (cells.size() != 3) {
            ADD_FAILURE() << "not three cells: " << line;
            continue;
        }
        techniques.push_back({cells[0], cells[2], quoted_words(cells[1])});
    }
    return techniques;
}

testing::AssertionResult has_every_row(const std::vector<Technique>& techniques) {
    std::set<std::string> named;
    for (const Technique& technique : techniques)
        named.insert(technique.rows.begin(), technique.rows.end());
    for (const StageInfo& stage : all_stages())
        if (named.count(std::string(stage.text.id)) == 0)
            return testing::AssertionFailure() << stage.text.id << " is in no table";
    return testing::AssertionSuccess();
}

testing::AssertionResult has_rows_that_exist(const std::vector<Technique>& techniques) {
    for (const Technique& technique : techniques)
        for (const std::string& id : technique.rows)
            if (find_stage(id) == nullptr)
                return testing::AssertionFailure() << technique.name << ": no row " << id;
    return testing::AssertionSuccess();
}

testing::AssertionResult says_why_there_is_none(const std::vector<Technique>& techniques) {
    for (const Technique& technique : techniques)
        if (technique.rows.empty() != technique.remark.starts_with(" no row"))
            return testing::AssertionFailure() << technique.name << ": " << technique.remark;
    return testing::AssertionSuccess();
}

/// The text with one of its words replaced.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = readme_text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Techniques, HaveEveryRow) {
    const auto techniques = techniques_of(readme_text());
    EXPECT_GE(techniques.size(), 70u);
    EXPECT_TRUE(has_every_row(techniques));
    EXPECT_TRUE(has_rows_that_exist(techniques));
    EXPECT_TRUE(says_why_there_is_none(techniques));
}

TEST(Techniques, WhatIsWrongIsNoticed) {
    EXPECT_FALSE(has_every_row(techniques_of(changed("`rabbid-pom`", ""))));
    EXPECT_FALSE(has_every_row(techniques_of(changed("`rabbid-pom`", "rabbid-pom"))));
    EXPECT_FALSE(has_rows_that_exist(techniques_of(changed("`gdm`", "`gdn`"))));
    EXPECT_FALSE(says_why_there_is_none(
        techniques_of(changed("no row: a surface for haptic", "a surface for haptic"))));
}

}  // namespace
}  // namespace quadrel::test
