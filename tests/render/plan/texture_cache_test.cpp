// A scene that is rendered again has its textures ready, and sees files that have changed.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include "quadrel/error.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// Bytes that this process has read so far, from whatever file.
std::uint64_t bytes_read() {
    std::ifstream counts("/proc/self/io");
    std::string name;
    std::uint64_t count = 0;
    counts >> name >> count;
    return name == "rchar:" ? count : 0;
}

constexpr int cached_side = 192;

void write_heights(const std::filesystem::path& file, int seed) {
    Film film{{0, 0, cached_side, cached_side}, {0, 0, cached_side, cached_side}, {}};
    for (const char* name : {"R", "G", "B", "A"}) {
        Plane& plane = film.add(name, ChannelType::float32);
        for (int i = 0; i < cached_side * cached_side; ++i)
            plane.bits[static_cast<std::size_t>(i)] =
                std::bit_cast<std::uint32_t>(static_cast<float>(noise(i, seed, 0)));
    }
    write_exr(file, film, {}, {ExrCompression::none, 1});
}

/// One file as colour and, twice, as height: by its levels, and for the map that is baked of it.
class TextureFiles : public testing::Test {
  protected:
    TextureFiles() {
        setenv("QUADREL_CACHE_MIB", "0", 1);
        write_heights(file, 1);
        testing_films::write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [32, 32],
            "textures": {"a": {"file": "a.exr"}, "h": {"file": "a.exr", "swizzle": "g"}},
            "materials": {"m": {"color": "a", "height": "h",
                                "relief": {"trace": "cone-step", "depth": 0.1}}},
            "objects": [{"mesh": {"shape": "quad"}, "material": "m"}]})");
    }
    ~TextureFiles() override { unsetenv("QUADREL_CACHE_MIB"); }

    Scene load() const { return load_scene(folder / "s.json"); }

    const testing_films::TemporaryFolder folder;
    const std::filesystem::path file = folder / "a.exr";
};

Film draw(const Scene& scene) { return render(scene, {}); }

TEST_F(TextureFiles, AreReadOnce) {
    if (bytes_read() == 0) GTEST_SKIP() << "this system does not count";
    const Scene scene = load();
    // A file that has just been changed is read every time, since one more change might not show.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    draw(scene);
    const auto read_by = [](const Scene& again) {
        const std::uint64_t before = bytes_read();
        draw(again);
        return bytes_read() - before;
    };
    const std::uint64_t size = std::filesystem::file_size(file);
    EXPECT_LT(read_by(scene), size / 2);
    Scene copy = scene;
    copy.materials[0].depth = 0.2f;
    EXPECT_LT(read_by(copy), size / 2);
    copy.texture_cache = std::make_shared<TextureCache>();  // planted: nothing is kept
    const std::uint64_t anew = read_by(copy);
    EXPECT_GT(anew, size);
    EXPECT_LT(anew, 2 * size) << "one file, read for each texture";
}

TEST_F(TextureFiles, GiveTheFilmOfAFreshScene) {
    const Scene first = load();
    draw(first);
    Scene moved = first;
    moved.camera.view = glm::mat4(translation({0.1, -0.2, -0.3})) * moved.camera.view;
    Scene fresh = moved;
    fresh.texture_cache = std::make_shared<TextureCache>();
    EXPECT_EQ(draw(moved), draw(fresh));
    EXPECT_NE(draw(moved), draw(first));
    RenderOptions options;
    options.channels = {"hit", "N"};
    options.window = Window{3, 5, 20, 30};
    EXPECT_EQ(render(first, options), render(load(), options));
}

/// `again` renders a scene whose film was `old`, after its file has changed.
testing::AssertionResult sees_the_change(
    const std::filesystem::path& file, const Scene& scene,
    const std::function<Film(const Scene&, const Film&)>& again) {
    for (int seed = 2; seed < 5; ++seed) {
        const Film old = draw(scene);
        write_heights(file, seed);  // the same size, within the same tick of the clock
        Scene fresh = scene;
        fresh.texture_cache = std::make_shared<TextureCache>();
        const Film expected = draw(fresh);
        if (expected == old) return testing::AssertionFailure() << "nothing has changed";
        if (again(scene, old) != expected) return testing::AssertionFailure() << "a stale film";
    }
    return testing::AssertionSuccess();
}

TEST_F(TextureFiles, AreReadAgainWhenTheyChange) {
    const Scene scene = load();
    EXPECT_TRUE(sees_the_change(file, scene, [](const Scene& s, const Film&) { return draw(s); }));
    EXPECT_FALSE(  // planted: what was drawn before
        sees_the_change(file, scene, [](const Scene&, const Film& old) { return old; }));
}

TEST_F(TextureFiles, AreMissedWhenTheyAreGone) {
    const Scene scene = load();
    draw(scene);
    std::filesystem::remove(file);
    EXPECT_THROW(draw(scene), InputError);
}

}  // namespace
}  // namespace quadrel::render_tests
