#include "file/atomic_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <thread>

#include "file/atomic_files.hpp"
#include "file/temporary_registry.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

TEST(AtomicFile, WritesAndReplaces) {
    const TemporaryFolder folder;
    write_whole(folder / "a", "first, and longer");
    EXPECT_EQ(file_bytes(folder / "a"), "first, and longer");
    write_whole(folder / "a", "second");
    EXPECT_EQ(file_bytes(folder / "a"), "second");
    EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, SeekingBackRewrites) {
    const TemporaryFolder folder;
    for (const bool through : {false, true}) {
        const auto file = folder / (through ? "link" : "file");
        if (through) std::filesystem::create_symlink(folder / "target", file);
        AtomicFile output(file);
        output.write("0123456789", 10);
        output.seek(2);
        output.write("xy", 2);
        EXPECT_EQ(output.position(), 4u);
        output.commit();
        EXPECT_EQ(file_bytes(file), "01xy456789");
    }
}

TEST(AtomicFile, UntouchedAndTidyWithoutCommit) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    {
        AtomicFile output(folder / "a");
        output.write("new", 3);
        EXPECT_EQ(file_bytes(folder / "a"), "old");
        EXPECT_EQ(folder.count(), 2u);
    }
    EXPECT_EQ(file_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, KeepsPermissionsAndObeysTheUmask) {
    const TemporaryFolder folder;
    const auto mode = [&](const char* name) {
        struct stat status = {};
        stat((folder / name).c_str(), &status);
        return status.st_mode & 0777;
    };
    const mode_t old = umask(0027);
    write_whole(folder / "fresh", "x");
    umask(old);
    EXPECT_EQ(mode("fresh"), 0640u);
    chmod((folder / "fresh").c_str(), 0604);
    write_whole(folder / "fresh", "y");
    EXPECT_EQ(mode("fresh"), 0604u);
}

TEST(AtomicFile, LinksAreWrittenThrough) {
    const TemporaryFolder folder;
    write_bytes(folder / "target", "a long old content");
    std::filesystem::create_symlink("target", folder / "link");
    write_whole(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(file_bytes(folder / "target"), "new");
}

TEST(AtomicFile, FifosAreWrittenThrough) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] { read = file_bytes(folder / "fifo"); });
    const std::string text(200000, 'q');
    write_whole(folder / "fifo", text);
    reader.join();
    EXPECT_EQ(read, text);
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "fifo"));
}

TEST(AtomicFile, DevicesStayDevices) {
    EXPECT_THROW(write_whole("/dev/full", "x"), OutputError);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    write_whole("/dev/null", "x");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, PlacesThatCannotBeWritten) {
    const TemporaryFolder folder;
    EXPECT_THROW(AtomicFile(folder.path()), OutputError);
    EXPECT_THROW(AtomicFile(folder / "a/"), OutputError);
    EXPECT_THROW(AtomicFile(folder / "missing/a"), OutputError);
    EXPECT_THROW(AtomicFile(""), OutputError);
    EXPECT_THROW(AtomicFile("/proc/quadrel-test"), OutputError);
    write_bytes(folder / "file", "x");
    EXPECT_THROW(AtomicFile(folder / "file/a"), OutputError);
    EXPECT_THROW(write_whole(folder / std::string(300, 'n'), "x"), OutputError);
    EXPECT_EQ(folder.count(), 1u);
}

TEST(AtomicFile, NamesAsLongAsNamesCanBe) {
    const TemporaryFolder folder;
    write_whole(folder / std::string(255, 'n'), "x");
    EXPECT_EQ(file_bytes(folder / std::string(255, 'n')), "x");
}

/// Runs `body` in a child process. Returns its exit code, or 1000 + the signal that ended it.
int exit_code_of(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/// A limit on file sizes stands for a full disk: write() fails half-way.
int exit_code_on_full_disk(const std::function<void()>& body) {
    return exit_code_of([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit = {20000, 20000};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            body();
        } catch (const OutputError&) {
            _exit(5);
        }
    });
}

TEST(AtomicFile, FullDiskLeavesTheOldFile) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    EXPECT_EQ(exit_code_on_full_disk([&] { write_whole(folder / "a", std::string(30000, 'x')); }),
              5);
    EXPECT_EQ(exit_code_on_full_disk([&] { write_whole(folder / "b", "small"); }), 0);
    EXPECT_EQ(file_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.count(), 2u);
}

/// OpenEXR's destructor writes the offset table and swallows errors: a limit between the pixels'
/// size and the file's must be noticed all the same, and so must every other limit.
TEST(AtomicFile, ExrNoticesAFullDiskWhereverItHappens) {
    const TemporaryFolder folder;
    const Film film = testing_films::random_film(1);
    write_exr(folder / "whole.exr", film, {});
    const auto size = std::filesystem::file_size(folder / "whole.exr");
    for (std::size_t limit = 0; limit < size; limit += 1 + size / 50) {
        const int code = exit_code_of([&] {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit rule = {limit, limit};
            setrlimit(RLIMIT_FSIZE, &rule);
            try {
                write_exr(folder / "cut.exr", film, {});
            } catch (const OutputError&) {
                _exit(5);
            }
        });
        EXPECT_EQ(code, 5) << limit;
    }
    EXPECT_EQ(folder.count(), 1u);
    EXPECT_THROW(write_exr("/dev/full", film, {}), OutputError);
}

TEST(AtomicFile, SignalsRemoveTheTemporary) {
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
        std::signal(signal, SIG_DFL);
        const int result = exit_code_of([&, number = signal] {
            install_signal_cleanup();
            AtomicFile output(folder / "a"), second(folder / "b");
            output.write("new", 3);
            std::raise(number);
        });
        EXPECT_EQ(result, code);
        EXPECT_EQ(folder.count(), 1u) << signal;
    }
    EXPECT_EQ(file_bytes(folder / "a"), "old");
}

TEST(AtomicFile, WithoutTheHandlerTheTemporaryStays) {
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_of([&] {
                  AtomicFile output(folder / "a");
                  std::raise(SIGKILL);
              }),
              1000 + SIGKILL);
    EXPECT_EQ(folder.count(), 1u) << "what the signal test counts is really there";
}

TEST(AtomicFile, BrokenPipeIsAnError) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    const int code = exit_code_of([&] {
        install_signal_cleanup();
        const int reader = open((folder / "fifo").c_str(), O_RDONLY | O_NONBLOCK);
        try {
            AtomicFile output(folder / "fifo");
            output.write("x", 1);
            close(reader);
            output.commit();
        } catch (const OutputError&) {
            _exit(5);
        }
    });
    EXPECT_EQ(code, 5);
}

}  // namespace
}  // namespace quadrel
