#include "sweep/measure.hpp"

#include <algorithm>
#include <vector>

#include "kernels/select.hpp"
#include "quadrel/stats.hpp"
#include "render/plan/prepared.hpp"
#include "render/stats/stopwatch.hpp"

namespace quadrel::sweep {
namespace {

RepeatedTime summary_of(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return {times.front(), times[times.size() / 2]};
}

double milliseconds(const PhaseTime& time, int threads) {
    return threads == 1 ? time.cpu_ms : time.wall_ms;
}

double milliseconds(std::int64_t ns) { return 1e-6 * static_cast<double>(ns); }

/// Stage times of one drawing.
StageTimes draw_by_stages(Film& film, const PreparedRender& prepared,
                          const RenderOptions& options) {
    DrawRecord record;
    draw_into(film, prepared, options, &record, Recording::times);
    return record.stages;
}

void time_draws(const PreparedRender& prepared, const RenderOptions& options, int repeats,
                const std::string& trace, RunTime& time) {
    std::vector<double> draws, kernels, traces;
    Film film;
    draw_into(film, prepared, options, nullptr, Recording::nothing);  // caches, pages of the film
    for (int i = 0; i < repeats; ++i) {
        Stopwatch watch;
        draw_into(film, prepared, options, nullptr, Recording::nothing);
        draws.push_back(milliseconds(watch.lap(), options.threads));
        const StageTimes stages = draw_by_stages(film, prepared, options);
        kernels.push_back(milliseconds(total(stages).cpu_ns));
        const auto search = stages.find(trace);
        traces.push_back(search == stages.end() ? 0 : milliseconds(search->second.cpu_ns));
    }
    time.draw = summary_of(std::move(draws));
    time.kernel = summary_of(std::move(kernels));
    time.trace = summary_of(std::move(traces)).median;
}

}  // namespace

RunTime time_run(const Scene& scene, const RenderOptions& options, int repeats,
                 const std::string& trace) {
    RenderOptions own = options;
    own.channels = {"R", "G", "B", "A"};
    RunTime time;
    Stopwatch watch;
    const PreparedRender prepared = prepare_render(scene, own, select_kernels(own.number, own.isa));
    time.load_ms = watch.lap().wall_ms;
    time_draws(prepared, own, repeats, trace, time);
    return time;
}

RunCounts count_run(const Scene& scene, RenderOptions options) {
    RenderStats stats;
    options.channels = {"R", "G", "B", "A"};
    options.stats = &stats;
    options.touched = true;
    Film film;
    render_into(film, scene, options);
    RunCounts counts;
    counts.fragments = stats.covered_lanes;
    counts.helpers = stats.helper_lanes;
    const auto fragments = static_cast<double>(std::max<std::uint64_t>(1, stats.covered_lanes));
    for (const auto& [kind, look_ups] : stats.fetches_by_kind)
        counts.look_ups[kind] = static_cast<double>(look_ups) / fragments;
    counts.look_ups_in_all = static_cast<double>(stats.fetches.fetches) / fragments;
    counts.texels = stats.touched.texels;
    counts.lines = stats.touched.lines;
    counts.steps = static_cast<double>(stats.trace_steps) / fragments;
    return counts;
}

SearchCost search_cost(const Film& film) {
    const Plane &fetches = *film.find("hit.fetches"), &coverage = *film.find("A");
    constexpr int wide = 8, high = 4;
    double sum = 0, together = 0, fragments = 0;
    for (int y0 = film.window.y0; y0 < film.window.y1; y0 += high)
        for (int x0 = film.window.x0; x0 < film.window.x1; x0 += wide) {
            std::uint32_t most = 0, covered = 0;
            for (int y = y0; y < std::min(y0 + high, film.window.y1); ++y)
                for (int x = x0; x < std::min(x0 + wide, film.window.x1); ++x) {
                    const std::size_t i = film.index(x, y);
                    if (coverage.as_float(i) == 0) continue;
                    ++covered;
                    sum += fetches.bits[i];
                    most = std::max(most, fetches.bits[i]);
                }
            together += double(most) * covered;
            fragments += covered;
        }
    return fragments == 0 ? SearchCost{} : SearchCost{sum / fragments, together / fragments};
}

}  // namespace quadrel::sweep
