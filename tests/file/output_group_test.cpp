// Files of a group appear together.
#include "file/output_group.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "file/atomic_files.hpp"
#include "file/temporary_registry.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

TEST(OutputGroup, ShowsAllAtItsEnd) {
    const TemporaryFolder folder;
    write_bytes(folder / "old", "old");
    {
        OutputGroup group;
        write_whole(folder / "old", "new");
        write_whole(folder / "fresh", "fresh");
        EXPECT_EQ(file_bytes(folder / "old"), "old");
        EXPECT_FALSE(std::filesystem::exists(folder / "fresh"));
        group.commit();
        EXPECT_EQ(file_bytes(folder / "old"), "new");
        EXPECT_EQ(file_bytes(folder / "fresh"), "fresh");
    }
    EXPECT_EQ(folder.count(), 2u);
    write_whole(folder / "after", "at once");
    EXPECT_TRUE(std::filesystem::exists(folder / "after"));
}

TEST(OutputGroup, ShowsNothingWithoutCommit) {
    const TemporaryFolder folder;
    write_bytes(folder / "old", "old");
    {
        OutputGroup group;
        write_whole(folder / "old", "new");
        write_whole(folder / "fresh", "fresh");
    }
    EXPECT_EQ(file_bytes(folder / "old"), "old");
    EXPECT_EQ(folder.count(), 1u);
}

TEST(OutputGroup, WhatCannotBeWrittenThroughKeepsTheOthersBack) {
    const TemporaryFolder folder;
    OutputGroup group;
    write_whole(folder / "a", "a");
    write_whole("/dev/full", "b");
    write_whole(folder / "c", "c");
    EXPECT_THROW(group.commit(), OutputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    EXPECT_FALSE(std::filesystem::exists(folder / "c"));
}

TEST(OutputGroup, ARenameThatFailsTakesNewNamesBack) {
    const TemporaryFolder folder;
    OutputGroup group;
    write_whole(folder / "a", "a");
    write_whole(folder / "b", "b");
    std::filesystem::create_directory(folder / "b");
    EXPECT_THROW(group.commit(), OutputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

TEST(OutputGroup, CommitAloneDoesNotWait) {
    const TemporaryFolder folder;
    OutputGroup group;
    AtomicFile file(folder / "cache");
    file.write("x", 1);
    file.commit_alone();
    EXPECT_EQ(file_bytes(folder / "cache"), "x");
}

/// The code that a process with our handlers ends with.
int exit_code_with_handlers(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
        install_signal_cleanup();
        body();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

TEST(OutputGroup, ASignalBeforeRemovesAll) {
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_with_handlers([&] {
                  OutputGroup group;
                  for (int i = 0; i < 20; ++i) write_whole(folder / std::to_string(i), "x");
                  std::raise(SIGTERM);
              }),
              143);
    EXPECT_EQ(folder.count(), 0u);
}

TEST(OutputGroup, ASignalWhileOneHoldsWaits) {
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_with_handlers([&] {
                  {
                      const SignalHold hold;
                      std::raise(SIGINT);
                      write_bytes(folder / "a", "after the signal");
                  }
                  write_bytes(folder / "b", "never");
              }),
              130);
    EXPECT_TRUE(std::filesystem::exists(folder / "a"));
    EXPECT_FALSE(std::filesystem::exists(folder / "b"));
}

}  // namespace
}  // namespace quadrel
