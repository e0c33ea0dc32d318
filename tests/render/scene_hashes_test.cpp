// Every scene of data/scenes gives the committed picture, bit for bit, however it is rendered.
//
// After a deliberate change of an algorithm, from the top of the source tree:
//
//     QUADREL_WRITE_HASHES=tests/render/expected_hashes.txt build/.../tests/render_tests
//         --gtest_filter=SceneHashesFile.WriteFresh
//
// and say in the commit message what changed and why. All builds share the file, so an unoptimised
// build checks itself against an optimised one.
#include <cctype>
#include <cstdlib>

#include "built_isas.hpp"
#include "effort.hpp"
#include "kernels/select.hpp"
#include "quadrel/scene/load.hpp"
#include "render/hash_file.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

SceneHash hash_of(const std::string& name, const std::string& size, const Film& film) {
    return {name, size, short_hash(with_planes(film, default_channels())), short_hash(film)};
}

/// All but the frame's normal, which most scenes have as N already: the hashes are older.
std::vector<std::string> hashed_channels(const Scene& scene) {
    return without(all_channels(scene), {"frame_normal"});
}

Film take_all(const Renderer& renderer, const Scene& scene) {
    return take(renderer, scene, hashed_channels(scene));
}

Scene load_at(const std::string& name, const std::string& size) {
    return load_scene(name, {size_override(size)});
}

testing::AssertionResult same_hash(const SceneHash& expected, const SceneHash& found) {
    if (expected == found) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << found.scene << " " << found.size << " gives " << found.of_default << " "
           << found.of_all << ", expected " << expected.of_default << " " << expected.of_all;
}

std::vector<std::string> wide_isas() {
    std::vector<std::string> isas;
    for (const std::string& isa : built_isas())
        if (isa != "scalar") isas.push_back(isa);
    return isas;
}

/// Four windows with odd corners, joined.
Film take_in_windows(const Renderer& renderer, const Scene& scene, RenderOptions options) {
    const int x = scene.width / 2 | 1, y = scene.height / 3 | 1;
    std::vector<Film> parts;
    for (const Window& window :
         {Window{0, 0, x, y}, Window{x, 0, scene.width, y}, Window{0, y, x, scene.height},
          Window{x, y, scene.width, scene.height}}) {
        options.window = window;
        parts.push_back(renderer(scene, options));
    }
    return join(parts);
}

struct Run {
    std::string isa;
    int threads, tile;
    bool windows;
};

testing::AssertionResult same_run(const Renderer& renderer, const Scene& scene,
                                  const std::vector<std::string>& channels, const Film& expected,
                                  const Run& run) {
    RenderOptions options;
    options.channels = channels;
    options.isa = run.isa;
    options.threads = run.threads;
    options.tile = run.tile;
    const Film found =
        run.windows ? take_in_windows(renderer, scene, options) : renderer(scene, options);
    return same_bits(with_planes(expected, channels), found)
           << " (" << run.isa << ", " << run.threads << " threads, tile " << run.tile
           << (run.windows ? ", in windows)" : ")");
}

/// Every instruction set, 1 and 2 threads, tiles of 8 and 64, in one piece and in four.
testing::AssertionResult same_in_all_runs(const Renderer& renderer, const Scene& scene) {
    const std::vector<std::string> channels = hashed_channels(scene);
    const Film expected = take(renderer, scene, channels);
    std::vector<std::string> isas = wide_isas();
    isas.push_back("scalar");
    for (const std::string& isa : isas)
        for (const int threads : {1, 2})
            for (const int tile : {8, 64})
                for (const bool windows : {false, true})
                    if (auto result = same_run(renderer, scene, channels, expected,
                                               {isa, threads, tile, windows});
                        !result)
                        return result;
    return testing::AssertionSuccess();
}

/// The whole product for scenes that load quickly; on those of relief, whose textures take most of
/// the time, one run for each scene that differs from the reference in all respects at once:
/// instruction sets take turns.
testing::AssertionResult same_in_some_runs(const Renderer& renderer, const Scene& scene,
                                           const Film& expected, std::size_t turn) {
    std::vector<std::string> isas = wide_isas();
    isas.push_back("scalar");
    const std::string isa = isas[turn % isas.size()];
    const std::vector<std::string> channels =
        turn % 2 == 0 ? default_channels() : hashed_channels(scene);
    return same_run(renderer, scene, channels, expected, {isa, 2, 8, turn % 5 == 0});
}

/// What is left out, in loading, searching and drawing, does not show: at the scene's own size and
/// at an odd one.
testing::AssertionResult same_without_skipping(const Renderer& renderer, Scene scene) {
    for (const auto& [width, height] : {std::pair(scene.width, scene.height), std::pair(61, 43)}) {
        scene.width = width;
        scene.height = height;
        RenderOptions options;
        const Film found = renderer(scene, options);
        options.skip = false;
        if (auto same = same_bits(render(scene, options), found); !same)
            return same << " at " << width << "x" << height << " without skipping";
    }
    return testing::AssertionSuccess();
}

class SceneHashes : public testing::TestWithParam<std::string> {};

TEST_P(SceneHashes, AreTheCommittedOnesInEveryRun) {
    const std::vector<SceneHash> all = read_hashes(hash_file());
    const auto line = std::find_if(all.begin(), all.end(),
                                   [](const SceneHash& h) { return h.scene == GetParam(); });
    ASSERT_NE(line, all.end()) << "no committed hash";
    const Scene scene = load_at(line->scene, line->size);
    const Film film = take_all(render, scene);
    EXPECT_TRUE(same_hash(*line, hash_of(line->scene, line->size, film)));
    EXPECT_TRUE(
        same_in_some_runs(render, scene, film, static_cast<std::size_t>(line - all.begin())));
    if (!test::sanitized) {
        EXPECT_TRUE(same_without_skipping(render, scene));
    }
}

INSTANTIATE_TEST_SUITE_P(All, SceneHashes, testing::ValuesIn(installed_scenes()),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(SceneHashesFile, HasEveryScene) {
    std::vector<std::string> names;
    for (const SceneHash& line : read_hashes(hash_file())) names.push_back(line.scene);
    EXPECT_EQ(names, installed_scenes());
}

TEST(SceneHashesFile, AChangedBitIsNoticed) {
    const std::string name = "msaa-4", size = "40x30";
    const Scene scene = load_at(name, size);
    const auto hash = [&](Planted error) {
        return hash_of(name, size, take_all(with(error), scene));
    };
    EXPECT_TRUE(same_hash(hash(Planted::none), hash(Planted::none)));
    EXPECT_FALSE(same_hash(hash(Planted::none), hash(Planted::one_bit)));
}

TEST(SceneHashesFile, WriteFresh) {
    const char* file = std::getenv("QUADREL_WRITE_HASHES");
    if (!file) GTEST_SKIP() << "QUADREL_WRITE_HASHES names no file";
    std::vector<SceneHash> hashes;
    for (const std::string& name : installed_scenes()) {
        const std::string size = hash_size(load_scene(name));
        hashes.push_back(hash_of(name, size, take_all(render, load_at(name, size))));
    }
    write_hashes(file, hashes);
}

TEST(SameBits, InEveryRun) {
    EXPECT_TRUE(same_in_all_runs(render, load_at("msaa-4-centroid", "40x30")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("sampler-lod-bias", "41x31")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("spikes-60", "20x15")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("rows/frame-shell", "33x27")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("rows/shadow-shell", "33x27")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("silhouette-cubes", "45x23")));
    EXPECT_TRUE(same_in_all_runs(render, load_at("rows/multilayer-exact", "25x19")));
    EXPECT_TRUE(same_in_all_runs(render, varied_scene(1, Conventions::gl, 25, 17)));
    EXPECT_TRUE(same_in_all_runs(render, varied_scene(4, Conventions::d3d, 19, 21)));
}

TEST(SameBits, DifferencesAreNoticed) {
    const Scene scene = load_at("msaa-4", "40x30");
    EXPECT_TRUE(same_in_all_runs(with(Planted::none), scene));
    for (const Planted error : {Planted::isa_rounds, Planted::tile_seam, Planted::window_corner,
                                Planted::thread_dependent})
        EXPECT_FALSE(same_in_all_runs(with(error), scene)) << static_cast<int>(error);
    EXPECT_TRUE(same_without_skipping(with(Planted::none), scene));
    EXPECT_FALSE(same_without_skipping(with(Planted::one_bit), scene));
}

}  // namespace
}  // namespace quadrel::render_tests
