#include "sweep/measure.hpp"

#include <algorithm>
#include <vector>

#include "kernels/select.hpp"
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

/// Plans and loads, and tells how long that took.
PreparedRender prepare_timed(const Scene& scene, const RenderOptions& options, double& ms) {
    Stopwatch watch;
    PreparedRender prepared =
        prepare_render(scene, options, select_kernels(options.number, options.isa));
    ms = watch.lap().wall_ms;
    return prepared;
}

}  // namespace

MeasuredRun::MeasuredRun(const Scene& scene, const RenderOptions& options)
    : options_([&] {
          RenderOptions own = options;
          own.channels = {"R", "G", "B", "A"};
          return own;
      }()),
      prepared_(prepare_timed(scene, options_, load_ms_)) {
    draw_into(film_, prepared_, options_, &counted_, Recording::counts);
}

RunTime MeasuredRun::time(int repeats, double seconds, const std::string& trace) {
    std::vector<double> draws, kernels, traces;
    RenderOptions timed = options_;
    timed.progress = nullptr;
    Stopwatch watch;
    double spent_ms = 0;
    const auto lap = [&] {
        const double ms = milliseconds(watch.lap(), options_.threads);
        spent_ms += ms;
        return ms;
    };
    for (int i = 0; i < repeats && !(spent_ms > 1000 * seconds); ++i) {
        draw_into(film_, prepared_, timed, nullptr, Recording::nothing);
        draws.push_back(lap());
        const StageTimes stages = draw_by_stages(film_, prepared_, timed);
        kernels.push_back(milliseconds(total(stages).cpu_ns));
        const auto search = stages.find(trace);
        traces.push_back(search == stages.end() ? 0 : milliseconds(search->second.cpu_ns));
        // All has been drawn; but who is told may end it.
        if (options_.progress) options_.progress(1);
        lap();
    }
    const auto made = static_cast<int>(draws.size());
    return {summary_of(std::move(draws)), summary_of(std::move(kernels)),
            summary_of(std::move(traces)).median, made, load_ms_};
}

RunCounts MeasuredRun::count() const {
    DrawRecord marking;
    const TouchedTexels touched = mark_touched(prepared_, options_, marking);
    RunCounts counts;
    counts.fragments = counted_.covered_lanes;
    counts.helpers = counted_.helper_lanes;
    const auto fragments = static_cast<double>(std::max<std::uint64_t>(1, counts.fragments));
    for (int slot = 0; slot < texture_slot_count; ++slot) {
        const auto look_ups =
            static_cast<double>(marking.fetches[static_cast<std::size_t>(slot)].fetches);
        if (look_ups == 0) continue;
        counts.look_ups[std::string(slot_name(static_cast<TextureSlot>(slot)))] =
            look_ups / fragments;
        counts.look_ups_in_all += look_ups / fragments;
    }
    counts.texels = touched.total().texels;
    counts.lines = touched.total().lines;
    counts.steps = static_cast<double>(marking.trace_steps) / fragments;
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
