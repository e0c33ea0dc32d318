// The stage clock: times are booked on the stages that took them, sums are those of the system's
// clocks, and these are read twice a tile, not at every stage.
#include "render/stats/stage_clock.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "quadrel/scene/load.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::render_tests {
namespace {

/// Time that only the test moves on. A tick is `tick_ns` on the wall; the thread runs for the share
/// `running` of it.
struct FakeTime {
    std::uint64_t ticks = 0;
    double wall_ns = 0, cpu_ns = 0, tick_ns = 2, running = 1;
    int system_readings = 0, tick_readings = 0;
    bool moves_back = false;  ///< the next reading of ticks is on another processor

    void pass(std::uint64_t n) {
        ticks += n;
        wall_ns += static_cast<double>(n) * tick_ns;
        cpu_ns += static_cast<double>(n) * tick_ns * running;
    }
};

FakeTime* fake = nullptr;

TimeSource fake_source() {
    return {[] {
                ++fake->tick_readings;
                return fake->moves_back ? std::uint64_t(0) : fake->ticks;
            },
            [] {
                ++fake->system_readings;
                return static_cast<std::int64_t>(fake->wall_ns);
            },
            [] {
                ++fake->system_readings;
                return static_cast<std::int64_t>(fake->cpu_ns);
            }};
}

const char* const ids[] = {"first", "second", "third"};

/// A span of batches of one material: stage i takes 100 (i + 1) ticks, as much again passes between
/// stages.
void run_span(StageClock& clock, FakeTime& time, int batches) {
    clock.begin();
    for (int batch = 0; batch < batches; ++batch) {
        const bool is_timed = clock.begin_batch(ids, 256);
        for (unsigned i = 0; i < 3; ++i) {
            if (is_timed) clock.start(ids[i]);
            time.pass(100 * (i + 1));
            if (is_timed) clock.lap(i);
            time.pass(100 * (i + 1));
        }
    }
    clock.end();
}

using Times = std::function<StageTimes(const StageClock&)>;

StageTimes as_measured(const StageClock& clock) { return clock.times(); }

/// Two spans in which ticks are worth something else; few enough batches that all are timed.
testing::AssertionResult books_what_stages_took(const Times& times) {
    FakeTime time;
    fake = &time;
    StageClock clock(fake_source());
    run_span(clock, time, 3);
    time.tick_ns = 5;
    time.running = 0.5;
    run_span(clock, time, 3);
    const StageTimes found = times(clock);
    if (found.size() != 3) return testing::AssertionFailure() << found.size() << " stages";
    for (unsigned i = 0; i < 3; ++i) {
        const StageTime& stage = found.at(ids[i]);
        const std::int64_t ticks = 3 * 100 * (i + 1);
        if (stage.batches != 6 || stage.lanes != 6 * 256 || stage.fetches != 6 * i)
            return testing::AssertionFailure() << ids[i] << ": counts";
        if (std::abs(stage.wall_ns - ticks * (2 + 5)) > 2)
            return testing::AssertionFailure() << ids[i] << ": " << stage.wall_ns << " ns";
        if (std::abs(stage.cpu_ns - ticks * 2 - ticks * 5 / 2) > 2)
            return testing::AssertionFailure() << ids[i] << ": " << stage.cpu_ns << " ns of CPU";
    }
    return testing::AssertionSuccess();
}

TEST(StageClock, BooksWhatStagesTook) { EXPECT_TRUE(books_what_stages_took(as_measured)); }

TEST(StageClock, WrongBookingsAreNoticed) {
    const auto with = [](auto change) {
        return [change](const StageClock& clock) {
            StageTimes times = clock.times();
            change(times);
            return times;
        };
    };
    EXPECT_FALSE(books_what_stages_took(
        with([](StageTimes& t) { std::swap(t["first"].wall_ns, t["second"].wall_ns); })));
    EXPECT_FALSE(books_what_stages_took(
        with([](StageTimes& t) { t["third"].cpu_ns = t["third"].wall_ns; })));
    EXPECT_FALSE(books_what_stages_took(with([](StageTimes& t) { ++t["third"].fetches; })));
    EXPECT_FALSE(books_what_stages_took(with([](StageTimes& t) { t["fourth"] = {}; })));
}

/// The two clocks of the system twice a span, the counter at the ends and around one batch in
/// seven.
TEST(StageClock, ReadsClocksSeldom) {
    FakeTime time;
    fake = &time;
    StageClock clock(fake_source());
    run_span(clock, time, 1);
    EXPECT_EQ(time.system_readings, 4);
    EXPECT_EQ(time.tick_readings, 2 + 2 * 3);
    run_span(clock, time, 7000);
    EXPECT_EQ(time.system_readings, 8);
    EXPECT_LT(time.tick_readings, 2 * 3 * 1020);
}

/// A material that has few batches is timed, wherever they come among the others'.
TEST(StageClock, TimesMaterialsThatAreRare) {
    FakeTime time;
    fake = &time;
    StageClock clock(fake_source());
    clock.begin();
    for (int batch = 0; batch < 70; ++batch) {
        const char* const id = batch % 7 == 3 ? "rare" : "common";
        const bool is_timed = clock.begin_batch(id, 256);
        if (is_timed) clock.start(id);
        time.pass(100);
        if (is_timed) clock.lap(0);
    }
    clock.end();
    EXPECT_EQ(clock.times().at("rare").wall_ns, 10 * 100 * 2);
    EXPECT_EQ(clock.times().at("common").wall_ns, 60 * 100 * 2);
}

/// What is measured in some batches stands for all, by their lanes: half of them are half as long.
TEST(StageClock, BatchesThatAreNotTimedAreLikeTheOthers) {
    FakeTime time;
    fake = &time;
    StageClock clock(fake_source());
    clock.begin();
    for (int batch = 0; batch < 7000; ++batch) {
        const int lanes = batch % 2 == 0 ? 256 : 128;
        const bool is_timed = clock.begin_batch(ids, lanes);
        if (is_timed) clock.start(ids[0]);
        time.pass(std::uint64_t(lanes));
        if (is_timed) clock.lap(std::uint64_t(lanes) * 3);
    }
    clock.end();
    const StageTime stage = clock.times().at(ids[0]);
    EXPECT_EQ(stage.batches, 7000u);
    EXPECT_EQ(stage.lanes, 3500u * (256 + 128));
    EXPECT_EQ(stage.fetches, 3 * stage.lanes);
    EXPECT_NEAR(double(stage.wall_ns), 2.0 * double(stage.lanes), 4);
}

/// A thread that is moved to a processor whose counter is behind loses a stage's time, no more.
TEST(StageClock, CountersThatRunBackTakeNothingAway) {
    FakeTime time;
    fake = &time;
    StageClock clock(fake_source());
    clock.begin();
    time.pass(1000);
    ASSERT_TRUE(clock.begin_batch(ids, 256));
    clock.start("first");
    time.pass(100);
    time.moves_back = true;
    clock.lap(0);
    clock.end();
    const StageTimes times = clock.times();
    EXPECT_EQ(times.at("first").wall_ns, 0);
    EXPECT_EQ(times.at("first").cpu_ns, 0);
    EXPECT_EQ(times.at("first").batches, 1u);
}

/// By the real clocks: stages are a part of drawing, and not nothing. Few batches: all are timed.
TEST(StageClock, StagesAreAPartOfDrawing) {
    const Scene scene = load_scene(QUADREL_DATA_DIR "/scenes/thesis-quad.json", {"size=[32,32]"});
    RenderOptions options;
    options.threads = 1;
    const PreparedRender prepared = prepare_render(scene, options, select_kernels(options));
    const TimeSource time = processor_time();
    const std::int64_t wall = time.wall_ns(), cpu = time.cpu_ns();
    DrawRecord record;
    draw(prepared, options, &record);
    const std::int64_t wall_end = time.wall_ns(), cpu_end = time.cpu_ns();
    const StageTime sum = total(record.stages);
    EXPECT_GT(sum.wall_ns, 0);
    EXPECT_LE(sum.wall_ns, wall_end - wall);
    EXPECT_GT(sum.cpu_ns, 0);
    EXPECT_LE(sum.cpu_ns, cpu_end - cpu);
}

}  // namespace
}  // namespace quadrel::render_tests
