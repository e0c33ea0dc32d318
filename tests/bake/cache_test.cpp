// The disk cache: what it gives is what would be baked, whatever happened to its files.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "bake/files.hpp"
#include "bake/store/cache_entry.hpp"
#include "bake/store/disk_cache.hpp"
#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/error.hpp"

namespace quadrel::test {
namespace {

/// A folder that the environment names as the user's cache.
class UserCache {
  public:
    UserCache() {
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
        unsetenv("QUADREL_CACHE_MIB");
    }
    ~UserCache() {
        unsetenv("XDG_CACHE_HOME");
        unsetenv("QUADREL_CACHE_MIB");
    }
    std::vector<std::filesystem::path> entries() const {
        std::vector<std::filesystem::path> files;
        if (std::filesystem::exists(place()))
            for (const auto& entry : std::filesystem::directory_iterator(place()))
                files.push_back(entry.path());
        return files;
    }
    std::filesystem::path place() const { return folder_ / "quadrel/baked"; }

  private:
    TemporaryFolder folder_;
};

/// Whether the map had to be baked; its values have to be right in any case.
bool had_to_bake(const Texture& field, BakeKind kind = BakeKind::max_mip, bool disk = true) {
    BakedTextureOptions options;
    options.disk = disk;
    bool baked = false;
    options.progress = [&](double) { baked = true; };
    const Texels map = baked_texture(field, kind, repeat(), options);
    EXPECT_TRUE(same_texels(*map, *bake(field, kind, repeat())));
    EXPECT_EQ(map->id(), baked_id(field, kind, repeat()));
    return baked;
}

TEST(Cache, KeepsMapsFromOneUseToTheNext) {
    const UserCache cache;
    const Texels field = random_field(6, 5, 91);
    for (const BakeKindInfo& info : bake_kinds()) {
        EXPECT_TRUE(had_to_bake(*field, info.kind)) << info.name;
        EXPECT_FALSE(had_to_bake(*field, info.kind)) << info.name;
    }
    EXPECT_EQ(cache.entries().size(), bake_kinds().size());
    EXPECT_TRUE(had_to_bake(*random_field(6, 5, 92)));
}

TEST(Cache, MemoryHasAMapOnce) {
    const UserCache cache;
    const Texels field = random_field(6, 5, 93);
    const Texels first = baked_texture(*field, BakeKind::cone, repeat());
    for (const auto& entry : cache.entries()) std::filesystem::remove(entry);
    EXPECT_EQ(first, baked_texture(*field, BakeKind::cone, repeat()));
}

TEST(Cache, CanBeLeftOut) {
    const UserCache cache;
    const Texels field = random_field(6, 5, 94);
    EXPECT_TRUE(had_to_bake(*field, BakeKind::cone, false));
    EXPECT_TRUE(cache.entries().empty());
    setenv("QUADREL_CACHE_MIB", "0", 1);
    EXPECT_TRUE(had_to_bake(*field));
    EXPECT_TRUE(had_to_bake(*field));
    EXPECT_TRUE(cache.entries().empty());
    for (const char* nonsense : {"many", "-1", "1k", "99999999999"}) {
        setenv("QUADREL_CACHE_MIB", nonsense, 1);
        EXPECT_THROW(had_to_bake(*field), UsageError) << nonsense;
    }
}

// ---- Damage -------------------------------------------------------------------------------------

using Decode = std::function<Texels(const std::string& bytes, const std::string& id)>;

/// Any byte changed, any length cut, bytes added, another id: no map.
testing::AssertionResult trusts_whole_entries_only(const Decode& decode) {
    const Texels map = bake(*random_field(4, 3, 95), BakeKind::cone_cell, repeat());
    const std::string whole = encode_entry(*map);
    const Texels read = decode(whole, map->id());
    if (read == nullptr || !same_texels(*read, *map))
        return testing::AssertionFailure() << "not its own entry";
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
        if (decode(damaged, map->id())) return testing::AssertionFailure() << "byte " << i;
        if (decode(whole.substr(0, i), map->id()))
            return testing::AssertionFailure() << "cut " << i;
    }
    if (decode(whole + '\0', map->id())) return testing::AssertionFailure() << "a byte more";
    if (decode(whole, std::string(64, '0'))) return testing::AssertionFailure() << "another id";
    return testing::AssertionSuccess();
}

TEST(Cache, TrustsWholeEntriesOnly) {
    EXPECT_TRUE(trusts_whole_entries_only(decode_entry));
    // Taken by its name, and by everything but the last digit of the checksum.
    EXPECT_FALSE(trusts_whole_entries_only([](const std::string& bytes, const std::string&) {
        const std::size_t start = bytes.find('\n') + 1;
        return decode_entry(bytes, bytes.size() > start + 64 ? bytes.substr(start, 64) : "");
    }));
    EXPECT_FALSE(trusts_whole_entries_only([](std::string bytes, const std::string& id) {
        if (bytes.size() > 64) {
            const std::string digest =
                encode_entry(*bake(*random_field(4, 3, 95), BakeKind::cone_cell, repeat()));
            bytes.back() = digest.back();
        }
        return decode_entry(bytes, id);
    }));
}

TEST(Cache, MakesDamagedEntriesAnew) {
    const UserCache cache;
    const Texels field = random_field(7, 5, 96), other = random_field(7, 5, 97);
    EXPECT_TRUE(had_to_bake(*field));
    const auto entry = cache.entries().at(0);
    const std::string whole = bytes_of(entry);
    EXPECT_TRUE(had_to_bake(*other));
    std::string foreign;
    for (const auto& file : cache.entries())
        if (file != entry) foreign = bytes_of(file);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
    for (const std::string& damage : {flipped, whole.substr(0, whole.size() - 1), foreign,
                                      std::string("not a map"), std::string()}) {
        write_bytes(entry, damage);
        EXPECT_TRUE(had_to_bake(*field));
        EXPECT_EQ(bytes_of(entry), whole);
        EXPECT_FALSE(had_to_bake(*field));
    }
    // A folder or a link to nowhere in the entry's place.
    std::filesystem::remove(entry);
    std::filesystem::create_directory(entry);
    EXPECT_TRUE(had_to_bake(*field));
    std::filesystem::remove(entry);
    std::filesystem::create_symlink("nowhere", entry);
    EXPECT_TRUE(had_to_bake(*field));
}

// ---- Size ---------------------------------------------------------------------------------------

TEST(Cache, WhatWasUsedLongestAgoGoesFirst) {
    const TemporaryFolder folder;
    std::vector<Texels> maps;
    for (std::uint32_t seed = 0; seed < 4; ++seed)
        maps.push_back(bake(*random_field(16, 16, seed), BakeKind::max_mip, repeat()));
    const std::size_t size = encode_entry(*maps[0]).size();
    const DiskCache cache(folder.path(), 3 * size + size / 2);
    const auto age = [&](int map, int hours) {
        std::filesystem::last_write_time(
            cache.file_of(maps[map]->id()),
            std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
    };
    for (int i = 0; i < 3; ++i) cache.store(*maps[i]);
    age(0, 3);
    age(1, 2);
    age(2, 1);
    EXPECT_NE(cache.load(maps[0]->id()), nullptr);                   // used: now the youngest
    write_bytes(folder / "notes.txt", std::string(10 * size, 'x'));  // not the cache's
    cache.store(*maps[3]);
    EXPECT_NE(cache.load(maps[0]->id()), nullptr);
    EXPECT_EQ(cache.load(maps[1]->id()), nullptr);
    EXPECT_NE(cache.load(maps[2]->id()), nullptr);
    EXPECT_NE(cache.load(maps[3]->id()), nullptr);
    EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
}

TEST(Cache, DoesNotKeepWhatIsLargerThanItself) {
    const TemporaryFolder folder;
    const Texels map = bake(*random_field(16, 16, 3), BakeKind::max_mip, repeat());
    DiskCache(folder.path(), encode_entry(*map).size() - 1).store(*map);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// What a killed writer left counts and goes, but not while it may still be written.
TEST(Cache, RemovesWhatKilledWritersLeft) {
    const TemporaryFolder folder;
    const Texels map = bake(*random_field(16, 16, 3), BakeKind::max_mip, repeat());
    const std::size_t size = encode_entry(*map).size();
    for (const char* name : {".quadrel-old.tmp", ".quadrel-new.tmp"})
        write_bytes(folder / name, std::string(2 * size, 'x'));
    std::filesystem::last_write_time(
        folder / ".quadrel-old.tmp",
        std::filesystem::file_time_type::clock::now() - std::chrono::hours(48));
    DiskCache(folder.path(), 2 * size).store(*map);
    EXPECT_FALSE(std::filesystem::exists(folder / ".quadrel-old.tmp"));
    EXPECT_TRUE(std::filesystem::exists(folder / ".quadrel-new.tmp"));
}

// ---- Trouble ------------------------------------------------------------------------------------

TEST(Cache, AnUnwritableCacheIsNoError) {
    const Texels field = random_field(6, 5, 98);
    const TemporaryFolder folder;
    write_bytes(folder / "file", "x");
    for (const std::string& place : {std::string("/proc/none"), (folder / "file").string()}) {
        setenv("XDG_CACHE_HOME", place.c_str(), 1);
        EXPECT_TRUE(had_to_bake(*field));
    }
    // No home, and a cache home that is no absolute path.
    const std::string home = getenv("HOME") ? getenv("HOME") : "";
    unsetenv("HOME");
    setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_TRUE(had_to_bake(*field));
    EXPECT_FALSE(std::filesystem::exists("relative"));
    if (!home.empty()) setenv("HOME", home.c_str(), 1);
    unsetenv("XDG_CACHE_HOME");
}

/// Runs `body` in a process of its own; its exit code.
int in_child(const std::function<int()>& body) {
    const pid_t child = fork();
    if (child == 0) _exit(body());
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000;
}

/// A disk that takes only the first part of an entry, as a full one does.
TEST(Cache, AFullDiskIsNoErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const Texels map = bake(*random_field(32, 32, 99), BakeKind::max_mip, repeat());
    const int code = in_child([&] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit most{1024, 1024};
        setrlimit(RLIMIT_FSIZE, &most);
        DiskCache(folder.path(), 1 << 30).store(*map);
        return std::filesystem::is_empty(folder.path()) ? 0 : 1;
    });
    EXPECT_EQ(code, 0);
}

/// Processes that write and read the same entries at once see whole ones or none.
TEST(Cache, ProcessesShareIt) {
    const TemporaryFolder folder;
    std::vector<Texels> maps;
    for (std::uint32_t seed = 0; seed < 3; ++seed)
        maps.push_back(bake(*random_field(40, 40, seed), BakeKind::max_mip, repeat()));
    const std::size_t size = encode_entry(*maps[0]).size();
    // Room for two of three, so that entries go while others read them.
    const DiskCache cache(folder.path(), 2 * size);
    const auto use = [&] {
        for (int turn = 0; turn < 40; ++turn) {
            const Texture& map = *maps[turn % 3];
            const auto found = cache.load(map.id());
            if (found && !same_texels(*found, map)) return 1;
            cache.store(map);
        }
        return 0;
    };
    const pid_t other = fork();
    if (other == 0) _exit(use());
    EXPECT_EQ(use(), 0);
    int status = 0;
    waitpid(other, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().extension(), ".baked");
}

TEST(Cache, SaysWhyItDoesNotKeepAMap) {
    const Texels field = random_field(6, 5, 101);
    const TemporaryFolder folder;
    write_bytes(folder / "file", "x");
    BakedTextureOptions options;
    std::vector<std::string> reasons;
    options.not_kept = [&](const std::string& reason) { reasons.push_back(reason); };
    const auto bake_into = [&](const std::string& home) {
        setenv("XDG_CACHE_HOME", home.c_str(), 1);
        baked_texture(*field, BakeKind::max_mip, repeat(), options);
    };
    bake_into((folder / "file").string());
    EXPECT_EQ(reasons.size(), 1u);
    bake_into((folder / "fresh").string());
    bake_into((folder / "fresh").string());
    EXPECT_EQ(reasons.size(), 1u);
    // Switched off, and asked not to keep: nobody is disappointed.
    setenv("QUADREL_CACHE_MIB", "0", 1);
    bake_into((folder / "other").string());
    EXPECT_EQ(reasons.size(), 1u);
    options.must_keep = true;
    EXPECT_THROW(bake_into((folder / "other").string()), OutputError);
    unsetenv("QUADREL_CACHE_MIB");
    EXPECT_THROW(bake_into((folder / "file").string()), OutputError);
    EXPECT_NO_THROW(bake_into((folder / "fresh").string()));
    EXPECT_NO_THROW(bake_into((folder / "other").string()));
    unsetenv("XDG_CACHE_HOME");
}

/// Writing into a pipe waits for a reader, and a link leads elsewhere.
TEST(Cache, PipesAndLinksInAnEntrysPlaceAreReplaced) {
    const UserCache cache;
    const Texels field = random_field(7, 5, 102);
    EXPECT_TRUE(had_to_bake(*field));
    const auto entry = cache.entries().at(0);
    const std::string whole = bytes_of(entry);
    std::filesystem::remove(entry);
    ASSERT_EQ(mkfifo(entry.c_str(), 0600), 0);
    EXPECT_TRUE(had_to_bake(*field));
    EXPECT_EQ(bytes_of(entry), whole);
    std::filesystem::remove(entry);
    std::filesystem::create_symlink(cache.place().parent_path() / "elsewhere", entry);
    EXPECT_TRUE(had_to_bake(*field));
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(entry)));
    EXPECT_FALSE(std::filesystem::exists(cache.place().parent_path() / "elsewhere"));
}

// ---- Refusal ------------------------------------------------------------------------------------

const SamplerState bordered = sampler_with(Wrap::clamp_to_border, Wrap::mirror_once, 0.25f);

BakedTextureOptions impatient(double seconds) {
    BakedTextureOptions options;
    options.seconds_limit = seconds;
    options.input = "bricks.exr --channel a";
    options.key = "materials.m.relief";
    options.parameters["c_max"] = 0.5;
    return options;
}

/// The refusal of a map: the key, the command that bakes it, and `reason`.
testing::AssertionResult refuses(const Texture& field, const BakedTextureOptions& options,
                                 const std::string& reason) {
    try {
        baked_texture(field, BakeKind::cone, bordered, options);
        return testing::AssertionFailure() << "not refused";
    } catch (const InputError& error) {
        const std::string text = error.what();
        const std::string command =
            "`quadrel bake bricks.exr --channel a --kind cone --wrap-u clamp-to-border "
            "--wrap-v mirror-once --border 0.25 --param c_max=0.5`";
        for (const std::string& part : {reason, command})
            if (text.find(part) == std::string::npos) return testing::AssertionFailure() << text;
        if (error.key != options.key) return testing::AssertionFailure() << error.key;
        return testing::AssertionSuccess();
    }
}

TEST(BakedTexture, StopsAtTheLimitAndNamesTheCommand) {
    const UserCache cache;
    const Texels field = random_field(16, 16, 100);
    double told = 0;
    BakedTextureOptions options = impatient(0.01);
    options.progress = [&](double share) {
        told = share;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    };
    EXPECT_TRUE(refuses(*field, options, "takes more than 0.01 s"));
    EXPECT_GT(told, 0) << "it started";
    EXPECT_LT(told, 1);
    EXPECT_TRUE(cache.entries().empty());
    // Once baked, it is there.
    baked_texture(*field, BakeKind::cone, bordered, impatient(1e9));
    EXPECT_FALSE(refuses(*field, options, ""));
}

TEST(BakedTexture, RefusesAtOnceOnlyWhatIsHopeless) {
    const UserCache cache;
    const Texels field = random_field(16, 16, 103);
    BakedTextureOptions options = impatient(1e-12);
    bool started = false;
    options.progress = [&](double) { started = true; };
    EXPECT_TRUE(refuses(*field, options, "minutes at least"));
    EXPECT_FALSE(started);
}

/// Every kind that is not in time stops, whatever loop it is in.
TEST(BakedTexture, EveryKindStops) {
    const Texels field = random_field(32, 32, 104);
    for (const BakeKindInfo& info : bake_kinds()) {
        BakeOptions options;
        options.seconds_limit = 0;
        EXPECT_THROW(bake(*field, info.kind, repeat(), options), BakeStopped) << info.name;
    }
}

/// Of the size of the walls that come with Quadrel nothing is refused unseen; what would take hours
/// is.
TEST(BakedTexture, WhatIsHopeless) {
    for (const BakeKindInfo& info : bake_kinds())
        EXPECT_LT(bake_seconds_estimate(info.kind, 512, 512), 40) << info.name;
    EXPECT_LT(bake_seconds_estimate(BakeKind::cone, 1024, 1024), 120);
    EXPECT_GT(bake_seconds_estimate(BakeKind::relaxed_cone, 8192, 8192), 3600);
    EXPECT_LT(bake_seconds_estimate(BakeKind::cone_quick, 1024, 1024), 3);
    EXPECT_LT(bake_seconds_estimate(BakeKind::cone_cell, 1024, 1024), 3);
}

}  // namespace
}  // namespace quadrel::test
