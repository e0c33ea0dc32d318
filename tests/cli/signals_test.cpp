// quadrel render, ended by signals at random moments: the old file or the whole new one, and no
// temporary unless nothing could be done about it.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "cli/signals.hpp"
#include "effort.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

class Signals : public testing::Test {
  protected:
    Signals() {
        write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [160, 160],
            "objects": [{"mesh": "quad"}]})");
    }
    pid_t start_render(const char* color) const {
        return start({"render", "s.json", "-o", "a.exr", "-t", "1", "-D", color, "--channels",
                      "R,G,B,A,Z,P,N,uv"},
                     folder.path(), logs.path());
    }
    /// Names in the folder but for the scene and the output.
    std::size_t others() const {
        return folder.count() - (std::filesystem::exists(folder / "a.exr") ? 2 : 1);
    }
    void remove_temporaries() const {
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            if (entry.path().extension() == ".tmp") std::filesystem::remove(entry.path());
    }
    TemporaryFolder folder, logs;
};

constexpr const char* colors[] = {"background=[0,0,0]", "background=[0,0,1]"};

TEST_F(Signals, AHundredTimesTheFileIsWhole) {
    const int times = test::rounds(100);
    std::set<std::string> whole;
    std::chrono::microseconds longest{0};
    for (const char* color : colors) {
        const pid_t child = start_render(color);
        wait_for_handlers(child);
        const auto begin = Clock::now();
        ASSERT_EQ(wait_for(child), 0) << file_bytes(logs / "err");
        longest = std::max(
            longest, std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin));
        whole.insert(file_bytes(folder / "a.exr"));
    }
    ASSERT_EQ(whole.size(), 2u);
    std::mt19937 random(7);
    int ended_by_signal = 0;
    for (int i = 0; i < times; ++i) {
        const int signal = std::array{SIGINT, SIGTERM, SIGKILL}[static_cast<std::size_t>(i) % 3];
        const pid_t child = start_render(colors[i / 3 % 2]);
        wait_for_handlers(child);
        std::this_thread::sleep_for(
            std::chrono::microseconds(random() % static_cast<unsigned>(longest.count() + 1)));
        kill(child, signal);
        const int code = wait_for(child);
        const int expected = signal == SIGKILL ? 1000 + SIGKILL : 128 + signal;
        EXPECT_TRUE(code == expected || code == 0) << code << " after signal " << signal;
        EXPECT_TRUE(whole.contains(file_bytes(folder / "a.exr"))) << "signal " << signal;
        if (signal == SIGKILL) remove_temporaries();
        EXPECT_EQ(others(), 0u) << "after signal " << signal;
        ended_by_signal += code == expected;
    }
    EXPECT_GT(ended_by_signal, times / 5) << "signals arrive while it runs";
}

TEST_F(Signals, NothingIsThereWhereNothingWas) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const pid_t child = start_render(colors[0]);
        wait_for_handlers(child);
        kill(child, signal);
        const int code = wait_for(child);
        EXPECT_TRUE(code == 128 + signal || code == 0) << code;
        EXPECT_EQ(std::filesystem::exists(folder / "a.exr"), code == 0);
        EXPECT_EQ(others(), 0u);
        std::filesystem::remove(folder / "a.exr");
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
