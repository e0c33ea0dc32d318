// Commands of several outputs that are ended while they write: all of them or none; and what killed
// ones leave behind, the next run removes.
#include <gtest/gtest.h>
#include <sys/file.h>

#include <map>
#include <random>

#include "cli/signals.hpp"
#include "effort.hpp"
#include "file/temporary_file.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::smooth_film;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;
using Contents = std::map<std::string, std::string>;

Contents contents(const TemporaryFolder& folder) {
    Contents all;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        all[entry.path().filename()] = file_bytes(entry);
    return all;
}

std::size_t temporaries(const TemporaryFolder& folder) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        count += is_temporary_of_this_host(entry.path().filename().string());
    return count;
}

void write_noise(const std::filesystem::path& file, int side) {
    Film film = testing_films::random_film(7, {0, 0, side, side}, {0, 0, side, side});
    film.planes.resize(4);
    for (Plane& plane : film.planes)
        for (std::uint32_t& bits : plane.bits) bits = 0x3f000000 | (bits & 0x7fffff);
    write_exr(file, film, {});
}

/// Ends `mips` at moments of its run. Nothing, or every level.
TEST(Interrupted, MipsIsAllOrNothing) {
    const TemporaryFolder folder, inputs, logs;
    write_noise(inputs / "a.exr", 200);
    const std::vector<std::string> line{"mips", (inputs / "a.exr").string(), "-o", "m"};
    const auto begin = Clock::now();
    ASSERT_EQ(run(line, folder.path()).code, 0);
    const auto whole_run = Clock::now() - begin;
    const Contents whole = contents(folder);
    EXPECT_EQ(whole.size(), 8u);
    std::mt19937 random(3);
    int ended = 0;
    const int times = test::rounds(30);
    for (int i = 0; i < times; ++i) {
        for (const auto& [name, bytes] : whole) std::filesystem::remove(folder / name);
        const pid_t child = start(line, folder.path(), logs.path());
        wait_for_handlers(child);
        std::this_thread::sleep_for(whole_run * (random() % 1000) / 1000);
        kill(child, i % 2 ? SIGINT : SIGTERM);
        const int code = wait_for(child);
        EXPECT_TRUE(code == 0 || code == 130 || code == 143) << code;
        const Contents left = contents(folder);
        EXPECT_TRUE(left.empty() ? code != 0 : left == whole) << left.size() << ", code " << code;
        ended += left.empty();
    }
    EXPECT_GT(ended, 0) << "signals arrive while it runs";
}

/// A level that cannot be written, and the others are not there either.
TEST(Interrupted, MipsOnAFullDisk) {
    const TemporaryFolder folder, inputs;
    write_noise(inputs / "a.exr", 64);
    std::filesystem::create_symlink("/dev/full", folder / "m.2.exr");
    EXPECT_EQ(run({"mips", (inputs / "a.exr").string(), "-o", "m"}, folder.path()).code, 5);
    EXPECT_EQ(folder.count(), 1u);
}

/// SIGKILL leaves temporaries; the next run that ends by itself leaves none.
TEST(Interrupted, TheNextRunRemovesWhatKilledOnesLeft) {
    const TemporaryFolder folder, inputs, logs;
    write_noise(inputs / "a.exr", 300);
    const std::vector<std::string> line{"mips", (inputs / "a.exr").string(), "-o", "m"};
    const auto begin = Clock::now();
    ASSERT_EQ(run(line, folder.path()).code, 0);
    const auto whole_run = Clock::now() - begin;
    const Contents whole = contents(folder);
    std::mt19937 random(5);
    std::size_t most = 0;
    const int times = test::rounds(40);
    // On until one was killed while it wrote, however short a part of its run that is.
    for (int i = 0; i < times || (most == 0 && i < 400); ++i) {
        const pid_t child = start(line, folder.path(), logs.path());
        wait_for_handlers(child);
        std::this_thread::sleep_for(whole_run * (random() % 1000) / 1000);
        kill(child, SIGKILL);
        wait_for(child);
        most = std::max(most, temporaries(folder));
    }
    EXPECT_GT(most, 0u) << "some are killed while they write";
    ASSERT_EQ(run(line, folder.path()).code, 0);
    EXPECT_EQ(contents(folder), whole);
}

/// Runs side by side leave each other's temporaries alone, also while others are killed.
TEST(Interrupted, RunsSideBySide) {
    const TemporaryFolder folder, inputs, logs[3];
    write_noise(inputs / "a.exr", 200);
    const auto line = [&](int i) {
        return std::vector<std::string>{"mips", (inputs / "a.exr").string(), "-o",
                                        "m" + std::to_string(i)};
    };
    const int times = test::rounds(8);
    for (int turn = 0; turn < times; ++turn) {
        pid_t children[3];
        for (int i = 0; i < 3; ++i) children[i] = start(line(i), folder.path(), logs[i].path());
        kill(children[2], SIGKILL);
        for (int i = 0; i < 3; ++i) {
            const int code = wait_for(children[i]);
            EXPECT_EQ(code, i == 2 ? 1000 + SIGKILL : 0) << file_bytes(logs[i] / "err");
        }
    }
    ASSERT_EQ(run(line(2), folder.path()).code, 0);
    EXPECT_EQ(folder.count(), 3u * 8u);
}

}  // namespace
}  // namespace quadrel::cli_tests
