// What timing does to a drawing (nothing), and how look-ups in lockstep are counted.
#include "sweep/measure.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "kernels/select.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;

TEST(Measure, AClockChangesNoBitAndCountsNothing) {
    const Scene scene = load_scene("rows/linear", {"size=[24,20]"});
    const RenderOptions options;
    const PreparedRender prepared = prepare_render(scene, options, select_kernels("float", "auto"));
    DrawRecord timed, counted;
    const Film film = draw(prepared, options, &timed, Recording::times);
    EXPECT_EQ(film_hash(film), film_hash(draw(prepared, options, nullptr, Recording::nothing)));
    EXPECT_GT(timed.stages.at("linear").wall_ns, 0);
    EXPECT_EQ(total(timed.stages).fetches, 0u);
    EXPECT_EQ(timed.quads, 0u);
    draw(prepared, options, &counted, Recording::counts);
    EXPECT_GT(total(counted.stages).fetches, 0u);
    EXPECT_EQ(timed.stages.size(), counted.stages.size());
}

/// Who is told takes time: once a repetition, between two that are timed.
TEST(Measure, NobodyIsToldWhileSomethingIsTimed) {
    const Scene scene = load_scene("rows/linear", {"size=[200,200]"});
    RenderOptions options;
    int told = 0;
    options.progress = [&](double) { ++told; };
    MeasuredRun run(scene, options);
    EXPECT_GT(told, 1);  // tiles of the first drawing
    told = 0;
    EXPECT_EQ(run.time(3, 1e9, scene.materials[0].trace.id).repeats, 3);
    EXPECT_EQ(told, 3);
    told = 0;
    run.count();
    EXPECT_GT(told, 1);
}

/// Counts are those of a render with statistics, whatever has been timed before.
TEST(Measure, CountsAreThoseOfStatistics) {
    for (const char* name : {"rows/linear", "rows/cone-step", "rows/max-mip", "thesis-sphere"}) {
        const Scene scene = load_scene(name, {"size=[24,20]"});
        RenderOptions options;
        options.threads = 1;
        MeasuredRun run(scene, options);
        const RunTime time = run.time(2, 1e9, scene.materials[0].trace.id);
        EXPECT_GT(time.trace, 0) << name;
        EXPECT_EQ(time.repeats, 2) << name;
        EXPECT_EQ(run.time(9, 1e-9, scene.materials[0].trace.id).repeats, 1) << name;
        EXPECT_LE(time.draw.least, time.draw.median) << name;
        const RunCounts counts = run.count();
        RenderStats stats;
        options.channels = {"R", "G", "B", "A"};
        options.stats = &stats;
        options.touched = true;
        render(scene, options);
        EXPECT_EQ(counts.fragments, stats.covered_lanes) << name;
        EXPECT_EQ(counts.helpers, stats.helper_lanes) << name;
        EXPECT_EQ(counts.texels, stats.touched.texels) << name;
        EXPECT_EQ(counts.lines, stats.touched.lines) << name;
        const auto fragments = static_cast<double>(stats.covered_lanes);
        EXPECT_DOUBLE_EQ(counts.steps * fragments, static_cast<double>(stats.trace_steps)) << name;
        EXPECT_EQ(counts.look_ups.size(), stats.fetches_by_kind.size()) << name;
        for (const auto& [kind, look_ups] : stats.fetches_by_kind)
            EXPECT_DOUBLE_EQ(counts.look_ups.at(kind) * fragments, static_cast<double>(look_ups));
        EXPECT_NEAR(counts.look_ups_in_all * fragments, static_cast<double>(stats.fetches.fetches),
                    1e-6);
    }
}

/// 9 x 4 pixels: a block of 8 x 4, and a column that is one of its own.
Film film_of(const std::vector<std::uint32_t>& fetches) {
    Film film;
    film.frame = film.window = {0, 0, 9, 4};
    film.add("A", ChannelType::float32, std::bit_cast<std::uint32_t>(1.0f));
    film.add("hit.fetches", ChannelType::uint32).bits = fetches;
    return film;
}

TEST(Measure, ABlockTakesAsLongAsItsLongest) {
    std::vector<std::uint32_t> fetches(36, 2);
    EXPECT_EQ(search_cost(film_of(fetches)).mean, 2);
    EXPECT_EQ(search_cost(film_of(fetches)).lockstep, 2);
    fetches[3] = 10;
    EXPECT_DOUBLE_EQ(search_cost(film_of(fetches)).mean, (35 * 2 + 10) / 36.0);
    EXPECT_DOUBLE_EQ(search_cost(film_of(fetches)).lockstep, (32 * 10 + 4 * 2) / 36.0);
    Film covered = film_of(fetches);
    covered.planes[0].bits[3] = 0;  // nobody waits for what is not drawn
    EXPECT_EQ(search_cost(covered).lockstep, 2);
}

}  // namespace
}  // namespace quadrel::sweep_tests
