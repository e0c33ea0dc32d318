// The table of keys in the code and the reference in data/scenes/README.md say the same.
#include "io/scene_keys.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "io/suggest.hpp"

namespace quadrel {
namespace {

using Keys = std::set<std::string>;  // "section key"

Keys keys_in_code() {
    Keys keys;
    for (const SceneKey& row : scene_keys())
        keys.insert(std::string(row.section) + " " + std::string(row.key));
    return keys;
}

// Sections are headings "### `section`", keys the first cells "| `key` |" of the rows below.
Keys keys_in_reference(std::istream& text) {
    Keys keys;
    std::string section;
    for (std::string line; std::getline(text, line);) {
        if (line.rfind("#", 0) == 0) section.clear();
        if (line.rfind("### `", 0) == 0) section = line.substr(5, line.find('`', 5) - 5);
        if (!section.empty() && line.rfind("| `", 0) == 0)
            keys.insert(section + " " + line.substr(3, line.find('`', 3) - 3));
    }
    return keys;
}

testing::AssertionResult agree(const Keys& code, const Keys& reference) {
    for (const auto& key : code)
        if (!reference.count(key)) return testing::AssertionFailure() << "not explained: " << key;
    for (const auto& key : reference)
        if (!code.count(key)) return testing::AssertionFailure() << "not known: " << key;
    return testing::AssertionSuccess();
}

TEST(SceneKeys, TheReferenceExplainsEachKeyAndNoOther) {
    std::ifstream file(QUADREL_DATA_DIR "/scenes/README.md");
    Keys reference = keys_in_reference(file);
    EXPECT_TRUE(agree(keys_in_code(), reference));
    reference.erase("camera fov_y");
    EXPECT_FALSE(agree(keys_in_code(), reference));
    reference.insert("camera fov_y");
    reference.insert("camera zoom");
    EXPECT_FALSE(agree(keys_in_code(), reference));
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
    const std::vector<std::string> known = {"near", "far", "fov_y"};
    EXPECT_EQ(nearest_word("fov", known), "fov_y");
    EXPECT_EQ(nearest_word("something else", known), "");
    for (const auto& a : known)
        for (const auto& b : known) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
}

}  // namespace
}  // namespace quadrel
