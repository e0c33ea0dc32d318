// Folders that can be read through: of a size that a listing explains, and none for one file.
#include <gtest/gtest.h>

#include <map>

#include "sources/planted.hpp"
#include "sources/source_tree.hpp"

namespace quadrel::source_tests {
namespace {

using Folders = std::map<std::string, int>;

/// How many files lie in each folder itself.
Folders folders() {
    Folders count;
    for (const char* top : {"include/quadrel", "src", "tests", "bench"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(project() / top))
            if (entry.is_regular_file())
                ++count[entry.path().parent_path().lexically_relative(project()).generic_string()];
    return count;
}

/// Seeds of fuzzing and input files are data, projects of tests have files where CMake wants them,
/// and Python leaves its own.
bool is_data(const std::string& folder) {
    return folder.ends_with("__pycache__") || folder.starts_with("tests/fuzz/corpus") ||
           folder.starts_with("tests/data/") || folder.starts_with("tests/consumer");
}

testing::AssertionResult can_be_read_through(const Folders& folders) {
    for (const auto& [folder, count] : folders) {
        if (is_data(folder)) continue;
        if (count > 27) return testing::AssertionFailure() << folder << ": " << count << " files";
        if (count == 1) return testing::AssertionFailure() << folder << " for one file";
    }
    return testing::AssertionSuccess();
}

TEST(Folders, CanBeReadThrough) {
    EXPECT_TRUE(can_be_read_through(folders()));
    EXPECT_GT(folders().size(), 50u);
    EXPECT_FALSE(can_be_read_through({{"src/io", 119}}))
        << static_cast<int>(Planted::crowded_folder);
    EXPECT_FALSE(can_be_read_through({{"bench/memory", 1}}))
        << static_cast<int>(Planted::lonely_file);
}

}  // namespace
}  // namespace quadrel::source_tests
