// Every scene of data/scenes can be read, and says what it shows.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::test {
namespace {

std::vector<std::filesystem::path> scene_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(QUADREL_DATA_DIR) / "scenes"))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    return files;
}

testing::AssertionResult loads(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {}) {
    try {
        const Scene scene = load_scene(file, overrides);
        if (scene.objects.empty()) return testing::AssertionFailure() << file << ": no objects";
    } catch (const InputError& error) {
        return testing::AssertionFailure() << error.what();
    }
    return testing::AssertionSuccess();
}

TEST(Scenes, Load) {
    EXPECT_GE(scene_files().size(), 40u);
    for (const auto& file : scene_files()) EXPECT_TRUE(loads(file));
}

TEST(Scenes, AnUnreadableOneIsNoticed) {
    const auto scenes = std::filesystem::path(QUADREL_DATA_DIR) / "scenes";
    EXPECT_FALSE(loads(scenes / "thesis-quad.json", {"camera.fov_y=\"wide\""}));
    EXPECT_FALSE(loads(scenes / "missing.json"));
}

TEST(Scenes, StartWithAComment) {
    for (const auto& file : scene_files()) {
        std::ifstream in(file);
        std::string line;
        std::getline(in, line);
        EXPECT_EQ(line.substr(0, 3), "// ") << file;
    }
}

}  // namespace
}  // namespace quadrel::test
