// From fork to exit of the command line's smallest verbs.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "support/clock.hpp"

namespace quadrel::bench {
namespace {

/// Runs `quadrel list algorithms`, output to nowhere. CPU seconds, or -1 where it failed.
double list_algorithms() {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    char program[] = QUADREL_PROGRAM, verb[] = "list", kind[] = "algorithms";
    char* const arguments[] = {program, verb, kind, nullptr};
    char* const environment[] = {nullptr};
    pid_t child = 0;
    const int error = posix_spawn(&child, program, &actions, nullptr, arguments, environment);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    rusage used{};
    if (error != 0 || wait4(child, &status, 0, &used) != child || status != 0) return -1;
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

void startup(benchmark::State& state) {
    Least wall, cpu;
    for (auto _ : state) {
        double used = 0;
        const double time = timed(CLOCK_MONOTONIC, [&] { used = list_algorithms(); });
        if (used < 0) return state.SkipWithError("quadrel list failed");
        state.SetIterationTime(time);
        wall.add(time);
        cpu.add(used);
    }
    state.counters["least_wall_ms"] = 1e3 * wall.value();
    state.counters["least_cpu_ms"] = 1e3 * cpu.value();
}

BENCHMARK(startup)
    ->Name("startup/list")
    ->UseManualTime()
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace quadrel::bench
