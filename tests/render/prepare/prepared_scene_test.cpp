// A prepared scene: every frame is that of a fresh render, and nothing is read or made twice.
#include "quadrel/prepare.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "render/films.hpp"
#include "render/prepare/changes.hpp"

namespace quadrel::render_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Draws the next frame of a prepared scene; or does so with a planted error.
using NextFrame = std::function<Film(PreparedScene&)>;

Film next_frame(PreparedScene& prepared) { return prepared.draw(); }

/// What a render that has nothing from before draws.
Film fresh_frame(PreparedScene& prepared) {
    Scene fresh = prepared.scene();
    fresh.texture_cache = std::make_shared<TextureCache>();
    return render(fresh, prepared.options());
}

AssertionResult is_always_fresh(const NextFrame& next) {
    PreparedScene prepared = prepare(varied_scene(), {});
    const auto same = [&](const std::string& what) -> AssertionResult {
        if (auto equal = same_bits(fresh_frame(prepared), next(prepared)); !equal)
            return equal << ", after a change of " << what;
        return AssertionSuccess();
    };
    for (const Change& change : scene_changes()) {
        change.apply(prepared.scene());
        if (auto result = same(change.name); !result) return result;
    }
    RenderOptions& options = prepared.options();
    const std::pair<const char*, std::function<void()>> changes[] = {
        {"window",
         [&] {
             options.window = Window{3, 4, 21, 22};
         }},
        {"channels",
         [&] {
             options.channels = {"hit", "N", "A"};
         }},
        {"number type", [&] { options.number = "double"; }},
        {"skipping", [&] { options.skip = false; }},
        {"threads", [&] { options.threads = 1; }}};
    for (const auto& [name, apply] : changes) {
        apply();
        if (auto result = same(name); !result) return result;
    }
    return AssertionSuccess();
}

TEST(PreparedScene, DrawsWhatAFreshRenderDraws) { EXPECT_TRUE(is_always_fresh(next_frame)); }

TEST(PreparedScene, StaleFramesAreNoticed) {
    Film kept;
    EXPECT_FALSE(is_always_fresh([&](PreparedScene& prepared) {
        if (kept.planes.empty()) kept = prepared.draw();
        return kept;
    })) << "the first frame for ever";
    const Camera first = varied_scene().camera;
    EXPECT_FALSE(is_always_fresh([&](PreparedScene& prepared) {
        Scene stale = prepared.scene();
        stale.camera = first;
        return render(stale, prepared.options());
    })) << "geometry of the first camera";
}

TEST(PreparedScene, AssemblesGeometryOnlyWhereItChanges) {
    PreparedScene prepared = prepare(varied_scene(), {});
    EXPECT_EQ(prepared.assembled(), 1);
    int expected = 1;
    for (const Change& change : scene_changes()) {
        // What stages read of triangles depends on the stages.
        if (change.name == "a stage" || change.name == "a frame") continue;
        change.apply(prepared.scene());
        prepared.draw();
        EXPECT_EQ(prepared.assembled(), expected += change.moves) << change.name;
    }
}

/// Bytes that this process has read so far, from whatever file.
std::uint64_t bytes_read() {
    std::ifstream counts("/proc/self/io");
    std::string name;
    std::uint64_t count = 0;
    counts >> name >> count;
    return name == "rchar:" ? count : 0;
}

constexpr int side = 64;

std::filesystem::path write_map(const testing_films::TemporaryFolder& folder, int seed) {
    Film film{{0, 0, side, side}, {0, 0, side, side}, {}};
    for (const char* name : {"R", "G", "B", "A"}) {
        Plane& plane = film.add(name, ChannelType::float32);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            plane.bits[i] =
                std::bit_cast<std::uint32_t>(static_cast<float>(noise(int(i), seed, 0)));
    }
    write_exr(folder / "map.exr", film, {}, {ExrCompression::none, 1});
    return folder / "map.exr";
}

/// varied_scene with all maps in a file of its own, which has not just been written: one that has
/// is read every time, since one more change might not show.
PreparedScene scene_of_file(const testing_films::TemporaryFolder& folder) {
    Scene scene = varied_scene();
    const auto file = write_map(folder, 1);
    for (Material& material : scene.materials)
        for (auto& [slot, reference] : material.textures) reference.file = file;
    scene.materials[0].trace = stage("cone-step", "trace");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return prepare(std::move(scene));
}

struct Work {
    std::uint64_t bytes, textures;
};

Work work_of(PreparedScene& prepared) {
    const std::uint64_t bytes = bytes_read(), made = prepared.scene().texture_cache->made();
    prepared.draw();
    return {bytes_read() - bytes, prepared.scene().texture_cache->made() - made};
}

/// Baked maps are made, not read.
class PreparedFiles : public testing::Test {
  protected:
    PreparedFiles() { setenv("QUADREL_CACHE_MIB", "0", 1); }
    ~PreparedFiles() override { unsetenv("QUADREL_CACHE_MIB"); }
    const testing_films::TemporaryFolder folder;
};

TEST_F(PreparedFiles, AreReadOnceAndMadeOnce) {
    if (bytes_read() == 0) GTEST_SKIP() << "this system does not count";
    PreparedScene prepared = scene_of_file(folder);
    constexpr std::uint64_t own = 1024;  // what counting reads itself
    const auto idle = [&](const char* what) {
        const Work work = work_of(prepared);
        EXPECT_LT(work.bytes, own) << what;
        EXPECT_EQ(work.textures, 0u) << what;
    };
    idle("the first frame");
    prepared.scene().camera.view =
        glm::mat4(translation({0, 0, -0.5})) * prepared.scene().camera.view;
    idle("another camera");
    prepared.scene().materials[0].depth = 0.25f;
    idle("another depth");
    prepared.options().window = Window{2, 2, 30, 20};
    idle("a window");
    prepared.options().channels = {"hit", "Z"};
    idle("other channels");
    // Planted: nothing is kept.
    prepared.scene().texture_cache = std::make_shared<TextureCache>();
    const Work again = work_of(prepared);
    EXPECT_GT(again.bytes, std::uint64_t(side) * side * 16);
    EXPECT_GT(again.textures, 0u);
}

TEST_F(PreparedFiles, AreReadAgainWhenTheyChange) {
    PreparedScene prepared = scene_of_file(folder);
    const Film before = prepared.draw();
    write_map(folder, 2);
    const Film after = prepared.draw();
    EXPECT_NE(before, after);
    EXPECT_EQ(after, fresh_frame(prepared));
}

TEST(PreparedScene, WritesFilesToo) {
    const testing_films::TemporaryFolder folder;
    PreparedScene prepared = prepare(varied_scene());
    for (const float depth : {0.1f, 0.4f}) {
        prepared.scene().materials[0].depth = depth;
        prepared.draw_to_exr(folder / "found.exr");
        render_to_exr(folder / "expected.exr", prepared.scene(), prepared.options());
        EXPECT_EQ(testing_films::file_bytes(folder / "found.exr"),
                  testing_films::file_bytes(folder / "expected.exr"));
    }
    EXPECT_EQ(prepared.assembled(), 1);
}

TEST(PreparedScene, GoesOnAfterAnError) {
    PreparedScene prepared = prepare(varied_scene());
    prepared.options().progress = [](double) { throw std::out_of_range("enough"); };
    EXPECT_THROW(prepared.draw(), std::out_of_range);
    prepared.options().progress = nullptr;
    EXPECT_EQ(prepared.draw(), fresh_frame(prepared));
}

}  // namespace
}  // namespace quadrel::render_tests
