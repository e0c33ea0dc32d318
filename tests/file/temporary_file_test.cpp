// What a killed process left goes, and nothing else: not what is being written, by this process or
// another, and no file of another host.
#include "file/temporary_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <set>
#include <thread>

#include "file/atomic_file.hpp"
#include "film/films.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

TEST(TemporaryFile, NamesSayHostAndProcess) {
    std::set<std::string> names;
    for (int i = 0; i < 100; ++i) {
        const std::string name = temporary_name();
        EXPECT_TRUE(is_temporary_of_this_host(name)) << name;
        EXPECT_NE(name.find("-" + std::to_string(getpid()) + "-"), std::string::npos) << name;
        EXPECT_LE(name.size(), 255u);
        EXPECT_EQ(name.find('/'), std::string::npos) << name;
        names.insert(name);
        for (const std::string& other :
             {"x" + name, name + "x", name.substr(1), name.substr(0, name.size() - 1),
              ".quadrel-elsewhere-00000000-1-0123456789abcdef.tmp" + std::string(),
              name.substr(0, name.size() - 5) + ".tmp"})
            EXPECT_FALSE(is_temporary_of_this_host(other)) << other;
    }
    EXPECT_EQ(names.size(), 100u);
}

/// Runs `body` in a process of its own, which then waits to be killed; returns it.
pid_t start(const std::function<void()>& body) {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
        body();
        if (write(ready[1], "x", 1) != 1) _exit(1);
        while (true) pause();
    }
    char done = 0;
    EXPECT_EQ(read(ready[0], &done, 1), 1);
    close(ready[0]);
    close(ready[1]);
    return child;
}

void end(pid_t child) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
}

using Tidy = std::function<void(const std::filesystem::path&)>;

/// What is abandoned goes, and everything else stays.
testing::AssertionResult removes_the_abandoned_alone(const Tidy& tidy) {
    const TemporaryFolder folder;
    const pid_t writing = start([&] { new AtomicFile(folder / "b"); });
    AtomicFile mine(folder / "c");
    // The last, since each of them tidies up before it writes.
    end(start([&] { new AtomicFile(folder / "a"); }));
    const std::size_t with_all = folder.count();
    write_bytes(folder / "out.exr", "output");
    write_bytes(folder / ".quadrel-elsewhere-00000000-1-0123456789abcdef.tmp", "other host");
    write_bytes(folder / ".quadrel-notes.tmp", "a user's");
    std::filesystem::create_symlink("out.exr", folder / temporary_name());
    mkfifo((folder / temporary_name()).c_str(), 0600);
    tidy(folder.path());
    const std::size_t left = folder.count();
    end(writing);
    tidy(folder.path());
    const std::size_t at_last = folder.count();
    mine.write("x", 1);
    try {
        mine.commit();
    } catch (const OutputError& error) {
        return testing::AssertionFailure() << error.what();
    }
    if (with_all != 3) return testing::AssertionFailure() << with_all << " temporaries";
    if (left != 2 + 5) return testing::AssertionFailure() << left << " while one is written";
    if (at_last != 1 + 5) return testing::AssertionFailure() << at_last << " afterwards";
    if (file_bytes(folder / "c") != "x" || file_bytes(folder / "out.exr") != "output")
        return testing::AssertionFailure() << "an output is damaged";
    return testing::AssertionSuccess();
}

TEST(TemporaryFile, RemovesTheAbandonedAlone) {
    EXPECT_TRUE(removes_the_abandoned_alone(remove_abandoned));
    EXPECT_FALSE(removes_the_abandoned_alone([](const auto&) {}));
    const auto remove_if = [](const std::function<bool(const std::string&)>& goes) {
        return [=](const std::filesystem::path& folder) {
            std::vector<std::filesystem::path> files;
            for (const auto& entry : std::filesystem::directory_iterator(folder))
                if (goes(entry.path().filename().string())) files.push_back(entry.path());
            for (const auto& file : files) std::filesystem::remove(file);
        };
    };
    // Whatever looks like one; all of this host, locked or not; all but this process' own.
    EXPECT_FALSE(removes_the_abandoned_alone(
        remove_if([](const std::string& name) { return name.starts_with(".quadrel-"); })));
    EXPECT_FALSE(removes_the_abandoned_alone(remove_if(is_temporary_of_this_host)));
    EXPECT_FALSE(removes_the_abandoned_alone(remove_if([](const std::string& name) {
        return is_temporary_of_this_host(name) &&
               name.find("-" + std::to_string(getpid()) + "-") == std::string::npos;
    })));
}

TEST(TemporaryFile, FoldersGoWithAllThatIsInThem) {
    const TemporaryFolder folder;
    const auto make = [&] {
        const std::string name = temporary_name();
        EXPECT_GE(create_locked_folder(folder / name), 0);
        write_bytes(folder.path() / name / "inside", "text");
        return name;
    };
    const std::string mine = make();
    EXPECT_EQ(create_locked_folder(folder / mine), -1);  // the name is taken
    end(start([&] { make(); }));
    std::filesystem::create_directory(folder / "another");
    EXPECT_EQ(folder.count(), 3u);
    remove_abandoned(folder.path());
    EXPECT_EQ(folder.count(), 2u);
    EXPECT_EQ(file_bytes(folder.path() / mine / "inside"), "text");
}

/// A process that tidies up without pause finds files between their creation and their lock, and
/// between their last byte and their name; all of them are written nevertheless.
TEST(TemporaryFile, TidyingWhileOthersWrite) {
    const TemporaryFolder folder;
    std::atomic<bool> stop = false;
    const pid_t other = fork();
    if (other == 0)
        while (true) remove_abandoned(folder.path());
    std::thread tidier([&] {
        while (!stop) remove_abandoned(folder.path());
    });
    for (int i = 0; i < 100; ++i) {
        AtomicFile file(folder / ("f" + std::to_string(i % 5)));
        const std::string text = std::to_string(i);
        file.write(text.data(), text.size());
        ASSERT_NO_THROW(file.commit());
        ASSERT_EQ(file_bytes(folder / ("f" + std::to_string(i % 5))), text);
    }
    stop = true;
    tidier.join();
    end(other);
    EXPECT_EQ(folder.count(), 5u);
}

}  // namespace
}  // namespace quadrel
