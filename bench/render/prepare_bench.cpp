// What comes before drawing: reading the scene, and its textures with their mip chains.
#include <benchmark/benchmark.h>

#include "kernels/select.hpp"
#include "quadrel/scene/load.hpp"
#include "render/plan/prepared.hpp"
#include "support/clock.hpp"

namespace quadrel::bench {
namespace {

template <class Work>
void least_of(benchmark::State& state, const Work& work) {
    Least least;
    for (auto _ : state) {
        const double time = timed(CLOCK_PROCESS_CPUTIME_ID, work);
        state.SetIterationTime(time);
        least.add(time);
    }
    state.counters["least_ms"] = 1e3 * least.value();
}

void scene(benchmark::State& state) {
    least_of(state, [] { benchmark::DoNotOptimize(load_scene("thesis-quad")); });
}

void textures(benchmark::State& state) {
    const Scene read = load_scene("thesis-quad");
    const KernelTable& kernels = select_kernels("float", "auto");
    least_of(state, [&] {
        benchmark::DoNotOptimize(prepare_render(read, RenderOptions{}, kernels).geometry);
    });
}

BENCHMARK(scene)
    ->Name("prepare/scene")
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(textures)
    ->Name("prepare/textures")
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace quadrel::bench
