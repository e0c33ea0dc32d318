// Hashes of files, and when a known one is taken.
#include "file/file_hash.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "film/films.hpp"
#include "quadrel/error.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

using testing_films::TemporaryFolder;
using testing_films::write_bytes;

TEST(FileHash, IsThatOfTheBytes) {
    const TemporaryFolder folder;
    const std::size_t block = std::size_t(1) << 18;
    for (const std::size_t size :
         {std::size_t(0), std::size_t(1), block - 1, block, 3 * block + 7}) {
        std::string bytes(size, 'a');
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i / 7);
        write_bytes(folder / "a", bytes);
        EXPECT_EQ(file_hash(folder / "a"), sha256_hex(bytes)) << size;
    }
}

TEST(FileHash, OfWhatIsNoFile) {
    const TemporaryFolder folder;
    mkfifo((folder / "pipe").c_str(), 0600);
    for (const auto& file : {folder / "missing", folder.path(), folder / "pipe"}) {
        try {
            file_hash(file, "height.file");
            ADD_FAILURE() << file;
        } catch (const InputError& error) {
            EXPECT_EQ(error.key, "height.file");
            EXPECT_EQ(error.file, file);
        }
    }
}

/// Sets the time of writing back, so that a later change would show.
void settle(const std::filesystem::path& file) {
    const timespec times[2] = {{1000000000, 0}, {1000000000, 0}};
    utimensat(AT_FDCWD, file.c_str(), times, 0);
}

using Hash = std::function<std::string(const std::filesystem::path&)>;

/// Of equal size, at once, and with the times of writing set back to what they were.
testing::AssertionResult sees_changes(const Hash& hash) {
    const TemporaryFolder folder;
    const auto file = folder / "a";
    for (const char* bytes : {"one", "two", "six", "one"}) {
        write_bytes(file, bytes);
        settle(file);
        if (hash(file) != sha256_hex(bytes)) return testing::AssertionFailure() << bytes;
    }
    write_bytes(folder / "b", "two");
    settle(folder / "b");
    std::filesystem::rename(folder / "b", file);
    if (hash(file) != sha256_hex("two")) return testing::AssertionFailure() << "renamed";
    return testing::AssertionSuccess();
}

TEST(FileHash, SeesChanges) {
    EXPECT_TRUE(sees_changes([](const auto& file) { return file_hash(file); }));
    std::map<std::string, std::string> known;  // planted: a file is known by its name
    EXPECT_FALSE(sees_changes([&](const std::filesystem::path& file) {
        return known.try_emplace(file.string(), file_hash(file)).first->second;
    }));
    known.clear();  // planted: by name, size and time of writing
    EXPECT_FALSE(sees_changes([&](const std::filesystem::path& file) {
        struct stat status = {};
        stat(file.c_str(), &status);
        const std::string name = file.string() + std::to_string(status.st_size) + " " +
                                 std::to_string(status.st_mtim.tv_sec);
        return known.try_emplace(name, file_hash(file)).first->second;
    }));
}

}  // namespace
}  // namespace quadrel
