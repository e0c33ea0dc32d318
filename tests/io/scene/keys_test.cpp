// The table of keys in the code and the reference in data/scenes/README.md say the same.
#include "io/document/keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "text/suggest.hpp"

namespace quadrel {
namespace {

/// Value, default and meaning by "section key".
using Keys = std::map<std::string, std::array<std::string, 3>>;

Keys keys_in_code() {
    Keys keys;
    for (const SceneKey& row : scene_keys())
        keys[std::string(row.section) + " " + std::string(row.key)] = {
            std::string(row.value), std::string(row.standard), std::string(row.meaning)};
    return keys;
}

/// The cells of "| a | b |", blanks around them dropped.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t begin = 1; begin < line.size();) {
        const std::size_t end = std::min(line.find('|', begin), line.size());
        const std::string cell = line.substr(begin, end - begin);
        const std::size_t first = cell.find_first_not_of(' ');
        cells.push_back(first == std::string::npos
                            ? ""
                            : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
        begin = end + 1;
    }
    return cells;
}

// Sections are headings "### `section`", keys the rows "| `key` | value | default | meaning |".
Keys keys_in_reference(std::istream& text) {
    Keys keys;
    std::string section;
    for (std::string line; std::getline(text, line);) {
        if (line.rfind("#", 0) == 0) section.clear();
        if (line.rfind("### `", 0) == 0) section = line.substr(5, line.find('`', 5) - 5);
        if (section.empty() || line.rfind("| `", 0) != 0) continue;
        std::vector<std::string> cells = cells_of(line);
        cells.resize(4);
        keys[section + " " + cells[0].substr(1, cells[0].size() - 2)] = {cells[1], cells[2],
                                                                         cells[3]};
    }
    return keys;
}

testing::AssertionResult agree(const Keys& code, const Keys& reference) {
    for (const auto& [key, cells] : code) {
        const auto found = reference.find(key);
        if (found == reference.end())
            return testing::AssertionFailure() << "not explained: " << key;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (cells[i] != found->second[i])
                return testing::AssertionFailure()
                       << key << ": \"" << cells[i] << "\", explained as \"" << found->second[i];
    }
    for (const auto& [key, cells] : reference)
        if (!code.count(key)) return testing::AssertionFailure() << "not known: " << key;
    return testing::AssertionSuccess();
}

TEST(SceneKeys, TheReferenceExplainsEachKeyAndNoOther) {
    std::ifstream file(QUADREL_DATA_DIR "/scenes/README.md");
    const Keys reference = keys_in_reference(file);
    EXPECT_TRUE(agree(keys_in_code(), reference));
    Keys missing = reference, added = reference, other = reference;
    missing.erase("camera fov_y");
    EXPECT_FALSE(agree(keys_in_code(), missing));
    added["camera zoom"] = {};
    EXPECT_FALSE(agree(keys_in_code(), added));
    other["camera fov_y"][1] = "60";  // another default
    EXPECT_FALSE(agree(keys_in_code(), other));
}

/// Whether the words of the fuzzer of scenes have every key.
testing::AssertionResult has_every_key(const std::string& dictionary) {
    for (const SceneKey& row : scene_keys()) {
        const std::string word = "\\\"" + std::string(row.key) + "\\\":";
        if (dictionary.find("\n\"" + word + "\"\n") == std::string::npos)
            return testing::AssertionFailure() << "not in the dictionary: " << row.key;
    }
    return testing::AssertionSuccess();
}

TEST(SceneKeys, TheFuzzersDictionaryHasEachKey) {
    std::ifstream file(QUADREL_DATA_DIR "/../tests/fuzz/scene.dict");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_TRUE(has_every_key(text.str()));
    std::string without = text.str();
    const std::size_t at = without.find("\\\"layers_2\\\":");
    ASSERT_NE(at, std::string::npos);
    EXPECT_FALSE(has_every_key(without.replace(at, 4, "none")));
}

TEST(SceneKeys, SectionsBelowExist) {
    for (const SceneKey& row : scene_keys()) {
        const bool is_plain = row.below == Below::value;
        EXPECT_TRUE(is_plain || !keys_of_section(row.below_section).empty()) << row.key;
    }
}

TEST(Suggest, DistanceIsAMetricOnExamples) {
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("abc", "abc"), 0);
    EXPECT_EQ(edit_distance("qaud", "quad"), 1);  // neighbours swapped
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    // Only what is near for its length is meant.
    const std::vector<std::string> words = {"up", "sheet", "linear", "relief", "relief.depth", "J"};
    const auto nearest = [&](const char* word) { return nearest_word(word, words); };
    EXPECT_EQ(nearest("99"), "");
    EXPECT_EQ(nearest("help"), "");
    EXPECT_EQ(nearest("K"), "");
    EXPECT_EQ(nearest("liner"), "linear");
    EXPECT_EQ(nearest("linaer"), "linear");
    EXPECT_EQ(nearest("lniera"), "linear");
    EXPECT_EQ(nearest("lxnyzr"), "");
    EXPECT_EQ(nearest("relief.depth.thickness"), "relief.depth") << "the longest beginning";
    EXPECT_EQ(nearest("uproar"), "") << "two letters are no beginning";
    const std::vector<std::string> known = {"near", "far", "fov_y"};
    EXPECT_EQ(nearest_word("fov", known), "fov_y");
    EXPECT_EQ(nearest_word("something else", known), "");
    for (const auto& a : known)
        for (const auto& b : known) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
}

}  // namespace
}  // namespace quadrel
