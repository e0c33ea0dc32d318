// Drawing, textures and geometry being ready: nanoseconds a pixel, and two threads against one.
#include <benchmark/benchmark.h>

#include "kernels/select.hpp"
#include "support/baseline.hpp"
#include "support/clock.hpp"
#include "support/picture.hpp"

namespace quadrel::bench {
namespace {

/// One thread's CPU time over a frame that the quad fills: everything, the stages alone, and what
/// timing and counting them, as --stats does, adds to everything.
void pixel(benchmark::State& state, const PictureText& text, const std::string& isa) {
    const Picture picture(text, select_kernels("float", isa));
    const auto pixels = static_cast<double>(picture.covered());
    Least whole, counting, stages;
    for (auto _ : state) {
        const double time = timed(CLOCK_PROCESS_CPUTIME_ID, [&] { picture.draw(1); });
        state.SetIterationTime(time);
        whole.add(time);
        StageTimes times;
        counting.add(timed(CLOCK_PROCESS_CPUTIME_ID, [&] { picture.draw(1, &times); }));
        stages.add(1e-9 * static_cast<double>(total(times).cpu_ns));
    }
    state.counters["pixels"] = pixels;
    state.counters["ns_per_pixel"] = 1e9 * whole.value() / pixels;
    state.counters["counting_percent"] = 100 * (counting.value() / whole.value() - 1);
    state.counters["stages_ns_per_pixel"] = 1e9 * stages.value() / pixels;
}

/// Wall time of one and of two threads in turns; `cpu_ratio` is what the second thread costs in
/// CPU time, which other programs on the machine hardly change.
void threads(benchmark::State& state, const PictureText& text) {
    const Picture picture(text, select_kernels("float", "auto"));
    Least wall[2], cpu[2];
    for (auto _ : state) {
        for (int i = 0; i < 2; ++i) {
            const double cpu_start = seconds(CLOCK_PROCESS_CPUTIME_ID);
            wall[i].add(timed(CLOCK_MONOTONIC, [&] { picture.draw(i + 1); }));
            cpu[i].add(seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_start);
        }
        state.SetIterationTime(wall[1].value());
    }
    state.counters["one_ms"] = 1e3 * wall[0].value();
    state.counters["two_ms"] = 1e3 * wall[1].value();
    state.counters["speedup"] = wall[0].value() / wall[1].value();
    state.counters["cpu_ratio"] = cpu[1].value() / cpu[0].value();
}

const bool registered = [] {
    std::vector<std::string> sets = lane_sets();
    sets.insert(sets.begin(), "scalar");
    for (const PictureText& text : full_pictures()) {
        for (const std::string& isa : sets)
            benchmark::RegisterBenchmark((std::string("pixel/") + text.name + "/" + isa).c_str(),
                                         pixel, text, isa)
                ->UseManualTime()
                ->Iterations(isa == "scalar" ? 2 : 9)
                ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark((std::string("threads/") + text.name).c_str(), threads, text)
            ->UseManualTime()
            ->Iterations(9)
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}  // namespace
}  // namespace quadrel::bench
