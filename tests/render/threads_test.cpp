// The number of threads that is asked for is the number that works, processors or not; and what a
// render tells of itself without counting.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// How many threads finish a tile. Until as many as asked for have come, each tile takes a while.
std::size_t threads_of(int asked) {
    const Scene scene = load_scene(QUADREL_DATA_DIR "/scenes/msaa-4.json", {"size=[64,64]"});
    std::set<std::thread::id> seen;
    RenderOptions options;
    options.channels = {"A"};
    options.threads = asked;
    options.tile = 2;
    options.progress = [&](double) {
        seen.insert(std::this_thread::get_id());
        if (seen.size() < static_cast<std::size_t>(asked))
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
    };
    render(scene, options);
    return seen.size();
}

TEST(Threads, AsManyAsAskedFor) {
    EXPECT_EQ(threads_of(1), 1u);
    const int more = static_cast<int>(std::thread::hardware_concurrency()) + 3;
    EXPECT_EQ(threads_of(more), static_cast<std::size_t>(more));
}

/// Pixels whose coverage is not 0.
std::uint64_t covered_pixels(const Film& film) {
    const Plane& a = *film.find("A");
    return static_cast<std::uint64_t>(
        std::count_if(a.bits.begin(), a.bits.end(), [](std::uint32_t bits) { return bits != 0; }));
}

TEST(Summary, CountsThePixelsThatAreCovered) {
    for (const char* name : {"msaa-4", "thesis-sphere", "conventions-d3d", "rows/clip-path"}) {
        const Scene scene =
            load_scene(QUADREL_DATA_DIR "/scenes/" + std::string(name) + ".json", {"size=[40,30]"});
        for (const Window window : {Window{0, 0, 40, 30}, Window{3, 5, 22, 19}}) {
            RenderSummary summary;
            RenderOptions options;
            options.channels = {"A"};
            options.window = window;
            options.summary = &summary;
            options.tile = 8;
            const Film film = render(scene, options);
            EXPECT_EQ(summary.pixels, static_cast<std::uint64_t>(window.area())) << name;
            EXPECT_EQ(summary.covered, covered_pixels(film)) << name;
            EXPECT_GT(summary.covered, 0u) << name;
            EXPECT_GT(summary.draw.wall_ms, 0) << name;
            EXPECT_FALSE(summary.left_out.empty()) << name;
        }
    }
}

}  // namespace
}  // namespace quadrel::render_tests
