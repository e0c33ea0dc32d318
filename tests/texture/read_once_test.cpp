// How often files are read: bytes that this process has got by reading, as the kernel counts them.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "file/file_store.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/texture/texture_cache.hpp"
#include "texture/planted.hpp"

namespace quadrel {
namespace {

using testing_films::TemporaryFolder;

/// Bytes read so far, by whatever call; 0 where that is not told.
std::uint64_t bytes_read() {
    std::ifstream in("/proc/self/io");
    std::string name;
    std::uint64_t count = 0;
    while (in >> name >> count)
        if (name == "rchar:") return count;
    return 0;
}

using Loading = std::function<void(TextureCache&, const std::filesystem::path&)>;

/// As a scene is loaded and rendered.
void hash_and_load(TextureCache& cache, const std::filesystem::path& file) {
    cache.files().file_hash(file);
    cache.load(file);
}

/// The bytes that were hashed are gone.
void hash_elsewhere_and_load(TextureCache& cache, const std::filesystem::path& file) {
    TextureCache().files().file_hash(file);
    cache.load(file);
}

/// Of noise, so that headers do not count beside it.
std::filesystem::path write_noise(const TemporaryFolder& folder) {
    Film film{{0, 0, 200, 200}, {0, 0, 200, 200}, {}};
    std::uint32_t state = 1;
    for (std::uint32_t& bits : film.add("Y", ChannelType::float32).bits)
        bits = 0x3f000000u | (state = state * 1664525u + 1013904223u) >> 9;
    write_exr(folder / "noise.exr", film, {}, {ExrCompression::none, 1});
    return folder / "noise.exr";
}

/// How often all of the file was read.
double times_read(const Loading& loading) {
    const TemporaryFolder folder;
    const auto file = write_noise(folder);
    // Until then a second change of the file would not show, and nothing is taken for known.
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    TextureCache cache;
    const std::uint64_t before = bytes_read();
    loading(cache, file);
    const auto read = static_cast<double>(bytes_read() - before);
    return read / static_cast<double>(std::filesystem::file_size(file));
}

TEST(TextureCacheFiles, AreReadOnce) {
    if (bytes_read() == 0) GTEST_SKIP() << "the kernel does not count";
    EXPECT_LT(times_read(hash_and_load), 1.1);
    EXPECT_GT(times_read(hash_elsewhere_and_load), 1.9)
        << static_cast<int>(test::Planted::reads_twice);
}

/// What was hashed is not taken for what is there now.
TEST(TextureCacheFiles, AreReadAgainWhereTheyHaveChanged) {
    const TemporaryFolder folder;
    const auto file = write_noise(folder);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    TextureCache cache;
    cache.files().file_hash(file);
    Film other{{0, 0, 2, 2}, {0, 0, 2, 2}, {}};
    other.add("Y", ChannelType::float32, 0x3f800000u);
    write_exr(file, other, {});
    const auto texture = cache.load(file);
    EXPECT_EQ(texture->view().width[0], 2);
    EXPECT_EQ(texture->level_texels(0, 0)[0], 1.0f);
}

}  // namespace
}  // namespace quadrel
