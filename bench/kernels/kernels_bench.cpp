// CPU time inside the stage functions, one thread: each instruction set against Quad<float>
// without auto-vectorisation, taken in turns, so that both see the same machine.
#include <benchmark/benchmark.h>

#include <map>

#include "kernels/select.hpp"
#include "support/baseline.hpp"
#include "support/clock.hpp"
#include "support/picture.hpp"

namespace quadrel::bench {
namespace {

using LeastTimes = std::map<std::string, Least>;

/// Draws once; seconds per stage, and their sum under "".
double measure(const Picture& picture, LeastTimes& least) {
    StageTimes times;
    benchmark::DoNotOptimize(picture.draw(1, &times));
    for (const auto& [stage, time] : times) least[stage].add(1e-9 * double(time.cpu_ns));
    const double sum = 1e-9 * double(total(times).cpu_ns);
    least[""].add(sum);
    return sum;
}

/// `baseline_isa`: what the baseline is compiled for, "" for plain x86-64.
void against_baseline(benchmark::State& state, const PictureText& text, const std::string& isa,
                      const std::string& baseline_isa) {
    const Picture lanes(text, select_kernels("float", isa));
    const Picture baseline(text, baseline_kernels(baseline_isa));
    LeastTimes lane_times, baseline_times;
    for (auto _ : state) {
        measure(baseline, baseline_times);
        state.SetIterationTime(measure(lanes, lane_times));
    }
    state.counters["baseline_ms"] = 1e3 * baseline_times[""].value();
    state.counters["lanes_ms"] = 1e3 * lane_times[""].value();
    for (const auto& [stage, time] : lane_times)
        state.counters["x" + stage] = baseline_times[stage].value() / time.value();
}

void add(const PictureText& text, const std::string& isa, const std::string& baseline_isa) {
    const std::string against = baseline_isa.empty() ? "x86-64" : baseline_isa;
    const std::string name =
        std::string("kernels/") + text.name + "/" + isa + "/against:" + against;
    benchmark::RegisterBenchmark(name.c_str(), against_baseline, text, isa, baseline_isa)
        ->UseManualTime()
        ->Iterations(5)
        ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    for (const PictureText& text : thesis_pictures())
        for (const std::string& isa : lane_sets()) {
            add(text, isa, "");
            add(text, isa, isa);
        }
    return true;
}();

}  // namespace
}  // namespace quadrel::bench
