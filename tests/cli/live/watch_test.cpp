// render --watch: drawn again after a change, only where the change touches, with the bits of a
// render of its own.
#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <thread>

#include "cli/process.hpp"
#include "effort.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;
using Words = std::vector<std::string>;

/// Two squares side by side, each of a material with a texture of its own.
std::string watched_scene(const std::string& change = "", const std::string& by = "") {
    std::string text = R"({"quadrel": 1, "size": [128, 64],
        "camera": {"type": "orthographic", "height": 2},
        "materials": {
          "left": {"color": {"file": "left.exr"}, "shade": "shade-lambert"},
          "right": {"color": {"file": "right.exr"}, "shade": "shade-lambert"}},
        "objects": [
          {"name": "a", "mesh": {"shape": "quad", "size": 1}, "material": "left",
           "transform": [{"translate": [-1, 0, 0]}]},
          {"name": "b", "mesh": {"shape": "quad", "size": 1}, "material": "right",
           "transform": [{"translate": [1, 0, 0]}]}]})";
    if (!change.empty()) text.replace(text.find(change), change.size(), by);
    return text;
}

class Watch : public testing::Test {
  protected:
    void SetUp() override {
        write_bytes(folder / "scene.json", watched_scene());
        write_texture("left.exr", 1);
        write_texture("right.exr", 2);
    }
    void TearDown() override {
        if (child > 0) stop();
    }

    void write_texture(const std::string& name, unsigned seed) const {
        write_exr(folder / name, testing_films::smooth_film(seed, {0, 0, 16, 9}), {});
    }
    void begin(const Words& more = {}) {
        Words words{"render", "scene.json", "-o", "a.exr", "--watch"};
        words.insert(words.end(), more.begin(), more.end());
        child = start(words, folder.path(), logs.path());
        ASSERT_TRUE(said("watching ")) << file_bytes(logs / "err");
    }
    int stop() {
        kill(child, SIGINT);
        return wait_for(std::exchange(child, -1));
    }
    /// Waits until the text stands in what was said since the last time.
    bool said(const std::string& text) {
        const int patience = test::sanitized ? 6000 : 2000;
        for (int i = 0; i < patience; ++i) {
            const std::string all = file_bytes(logs / "err");
            const std::size_t found = all.find(text, heard);
            const std::size_t end = all.find('\n', found);
            if (found != std::string::npos && end != std::string::npos) {
                last = all.substr(heard, end - heard);
                heard = end + 1;
                return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    /// Whether it was said that so many pixels were drawn: what triangles can cover is told with a
    /// pixel more.
    AssertionResult drew(int width, int height, const std::string& of) const {
        static const std::regex pixels(
            ": ([0-9]+)x([0-9]+) of ([0-9x]+) pixels drawn in [0-9.]+ s$");
        std::smatch match;
        if (!std::regex_search(last, match, pixels)) return AssertionFailure() << last;
        const int over = std::stoi(match[1]) - width, above = std::stoi(match[2]) - height;
        const bool near = over >= 0 && over <= 2 && above >= 0 && above <= 2 && match[3] == of;
        return near ? AssertionSuccess() : AssertionFailure() << last;
    }
    /// Whether the image is that of a render of what is there now.
    AssertionResult is_drawn_anew(const Words& more = {}) const {
        Words words{"render", "scene.json", "-o", "b.exr"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words, folder.path());
        if (outcome.code != 0) return AssertionFailure() << outcome.err;
        return file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")
                   ? AssertionSuccess()
                   : AssertionFailure() << "other bytes";
    }
    TemporaryFolder folder, logs;
    pid_t child = -1;
    std::size_t heard = 0;
    std::string last;
};

TEST_F(Watch, OnlyWhatAChangeTouchesIsDrawn) {
    begin();
    EXPECT_TRUE(is_drawn_anew());
    write_texture("left.exr", 3);
    ASSERT_TRUE(said("left.exr changed: material \"left\": ")) << file_bytes(logs / "err");
    EXPECT_TRUE(drew(32, 32, "128x64"));
    EXPECT_TRUE(is_drawn_anew());

    write_bytes(folder / "scene.json", watched_scene("[1, 0, 0]", "[0.5, 0, 0]"));
    ASSERT_TRUE(said("scene.json changed: object \"b\": ")) << file_bytes(logs / "err");
    EXPECT_TRUE(drew(48, 32, "128x64"));
    EXPECT_TRUE(is_drawn_anew());

    write_bytes(folder / "scene.json", watched_scene("\"height\": 2", "\"height\": 3"));
    ASSERT_TRUE(said("the whole scene: 128x64 of 128x64 pixels")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());

    write_bytes(folder / "scene.json", watched_scene("[128, 64]", "[64, 64]"));
    ASSERT_TRUE(said("the whole scene: 64x64 of 64x64 pixels")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());
    EXPECT_EQ(stop(), 130);
}

TEST_F(Watch, WhatThePlanDoesNotReadTouchesNothing) {
    begin({"--channels", "uv"});
    write_texture("left.exr", 3);
    ASSERT_TRUE(said("left.exr changed: no pixel")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew({"--channels", "uv"}));  // its header says of what it is
    write_bytes(folder / "scene.json", watched_scene("\"shade-lambert\"", "\"shade-debug\""));
    ASSERT_TRUE(said("scene.json changed: no pixel")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew({"--channels", "uv"}));
    write_bytes(folder / "scene.json", watched_scene("\"color\": {\"file\": \"right.exr\"}",
                                                     "\"texture_matrix\": {\"scale\": [2, 2]}"));
    ASSERT_TRUE(said("scene.json changed: material \"right\": ")) << file_bytes(logs / "err");
    EXPECT_TRUE(drew(32, 32, "128x64"));
    EXPECT_TRUE(is_drawn_anew({"--channels", "uv"}));
}

TEST_F(Watch, MistakesAreSaidAndTheImageStays) {
    begin();
    const std::string image = file_bytes(folder / "a.exr");
    write_bytes(folder / "scene.json", "{\"quadrel\": 1, \"obj");
    ASSERT_TRUE(said("scene.json changed: ")) << file_bytes(logs / "err");
    EXPECT_NE(last.find("scene.json"), std::string::npos) << last;
    EXPECT_EQ(file_bytes(folder / "a.exr"), image);
    write_bytes(folder / "scene.json", watched_scene("left.exr", "a.exr"));
    ASSERT_TRUE(said("is the input")) << file_bytes(logs / "err");
    EXPECT_EQ(file_bytes(folder / "a.exr"), image);
    write_bytes(folder / "scene.json", watched_scene("left.exr", "right.exr"));
    ASSERT_TRUE(said("material \"left\"")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());
}

/// Editors write another file and rename it; new files of the scene are watched, too.
TEST_F(Watch, ReplacedAndNewFilesCount) {
    write_texture("new.exr", 5);
    begin();
    write_bytes(folder / "other.json", watched_scene("left.exr", "new.exr"));
    std::filesystem::rename(folder / "other.json", folder / "scene.json");
    ASSERT_TRUE(said("scene.json changed: material \"left\"")) << file_bytes(logs / "err");
    write_texture("new.exr", 6);
    ASSERT_TRUE(said("new.exr changed: material \"left\"")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());
}

/// A link's target lies in a folder of its own, and a folder may be replaced as a whole; what
/// others write there all the time does not matter.
TEST_F(Watch, LinksAndFoldersAreFollowed) {
    std::filesystem::create_directories(folder / "store");
    std::filesystem::create_directories(folder / "maps");
    write_texture("store/far.exr", 4);
    write_texture("maps/near.exr", 5);
    std::filesystem::create_symlink("store/far.exr", folder / "link.exr");
    std::string scene = watched_scene("left.exr", "link.exr");
    scene.replace(scene.find("right.exr"), 9, "maps/near.exr");
    write_bytes(folder / "scene.json", scene);
    begin();
    const std::jthread noise([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            write_bytes(folder / "noise.log", "x");
            write_bytes(folder / "store" / "noise.log", "x");
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    });
    write_texture("store/far.exr", 6);
    ASSERT_TRUE(said("link.exr changed: material \"left\"")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());

    std::filesystem::create_directories(folder / "other");
    write_texture("other/near.exr", 7);
    std::filesystem::rename(folder / "maps", folder / "old");
    ASSERT_TRUE(said("near.exr changed: ")) << file_bytes(logs / "err");
    std::filesystem::rename(folder / "other", folder / "maps");
    ASSERT_TRUE(said("near.exr changed: ")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());
    write_texture("maps/near.exr", 8);
    ASSERT_TRUE(said("near.exr changed: material \"right\"")) << file_bytes(logs / "err");
    EXPECT_TRUE(is_drawn_anew());
}

TEST_F(Watch, WrongCommandLinesAreOneLine) {
    for (const Words& more :
         std::vector<Words>{{"--explain"}, {"--stats", "s.json"}, {"--task", "1/1"}}) {
        Words words{"render", "scene.json", "-o", "a.exr", "--watch"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words, folder.path());
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("--watch: expected"), std::string::npos) << outcome.err;
    }
    for (const Words& more :
         std::vector<Words>{{"-o", "/dev/stdout"}, {"-o", "a.exr", "--preview", "/dev/stderr"}}) {
        Words words{"render", "scene.json", "--watch"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words, folder.path());
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("found the output /dev/std"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"render", "none.json", "-o", "a.exr", "--watch"}, folder.path()).code, 3);
}

}  // namespace
}  // namespace quadrel::cli_tests
