#include "sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "sweep/part.hpp"
#include "sweep/plan/plan_checks.hpp"
#include "sweep/record.hpp"
#include "sweep/report/pictures.hpp"
#include "sweep/run_scenes.hpp"
#include "text/hash.hpp"
#include "text/threads.hpp"

namespace quadrel::sweep {
namespace {

/// Raised when records change their meaning.
constexpr int record_format = 2;

std::vector<double> pictured_angles(const Plan& plan) {
    if (!plan.pictures.angles.empty()) return plan.pictures.angles;
    double steepest = -1;
    for (const View& view : plan.views) steepest = std::max(steepest, view.angle.value_or(-1));
    return {steepest};
}

/// Which runs have thumbnails: the same ones whatever tasks they are shared out to.
std::vector<bool> pictured_runs(const Plan& plan, const std::vector<Run>& all) {
    const std::vector<double> angles = pictured_angles(plan);
    std::vector<bool> pictured;
    int left = plan.pictures.most;
    for (const Run& run : all) {
        const View& view = plan.views[run.view];
        const bool shown =
            !view.angle || std::find(angles.begin(), angles.end(), *view.angle) != angles.end();
        pictured.push_back(left > 0 && shown && run.number == plan.numbers[0] &&
                           run.isa == plan.isas[0] && run.threads == plan.threads[0]);
        left -= pictured.back() ? 1 : 0;
    }
    return pictured;
}

class Sweeper {
  public:
    Sweeper(const Plan& plan, const SweepOptions& options)
        : plan_(plan),
          options_(options),
          runs_(options.output / "runs"),
          scenes_(plan, options.output / "maps", options.pause) {}

    SweepOutcome run() {
        check_scenes(plan_);  // before anything is written
        make_folder(runs_);
        const std::vector<Run> all = runs_of(plan_);
        ask(all);
        const std::vector<bool> pictured = pictured_runs(plan_, all);
        const std::vector<Run> own = runs_of_task(all, options_.task, options_.of);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (options_.progress) options_.progress(i, own.size(), name_of(own[i]));
            const std::size_t order = static_cast<std::size_t>(options_.task - 1) +
                                      i * static_cast<std::size_t>(options_.of);
            outcome_.records.push_back(run_in_plan(own[i], order, pictured[order]));
        }
        return std::move(outcome_);
    }

  private:
    /// Says in the folder what it is to have.
    void ask(const std::vector<Run>& all) {
        std::vector<std::string> names;
        for (const Run& run : all)
            names.push_back(
                fmt::format("{}, {}, {}, {}", name_of(run), run.number, run.isa, run.threads));
        plan_id_ = plan_id(names);
        write_part(options_.output, {plan_.title, plan_id_, all.size(), options_.of});
    }

    std::string name_of(const Run& run) const {
        const PlannedMap& map = plan_.maps[run.map];
        return fmt::format("{}, {} {}, {}, {}", plan_.scenes[run.scene].name, map.name, map.size,
                           plan_.views[run.view].name(), plan_.algorithms[run.algorithm].name());
    }

    std::string key_of(const Scene& scene, const Run& run, const Machine& machine,
                       bool pictured) const {
        const Json what{record_format, name_of(run), scene.hash, run.number, run.isa, run.threads,
                        plan_.repeats,
                        // JSON has no infinity.
                        std::min(plan_.repeat_seconds, std::numeric_limits<double>::max()),
                        machine.build, machine.processor, plan_.wrong_texels,
                        pictured ? plan_.pictures.side : 0};
        return sha256_hex(what.dump()).substr(0, 32);
    }

    /// A scene that cannot be read with what the run changes is an error of the plan.
    Json run_in_plan(const Run& run, std::size_t order, bool pictured) {
        try {
            return run_one(run, order, pictured);
        } catch (const InputError& error) {
            throw InputError(
                plan_.file.string(), "",
                fmt::format("a run that cannot be made: {}: {}", name_of(run), error.what()),
                "a scene that takes its map and search");
        }
    }

    Json run_one(const Run& run, std::size_t order, bool pictured) {
        Run resolved = run;
        std::string reason;
        try {
            resolved.isa = select_kernels(run.number, run.isa).isa;
        } catch (const UsageError& error) {
            reason = error.what();
        }
        const RunScene scene = scenes_.scene_of(run);
        const Machine machine = this_machine(options_.version, resolved.isa);
        const std::string key = key_of(scene.scene, resolved, machine, pictured);
        if (auto known = read_record(runs_, key); known && !known->contains("failed"))
            return renamed(std::move(*known), run, order, scene);
        Json record = describe_run(plan_, resolved, machine);
        record["key"] = key;
        place(record, run, order, scene);
        if (reason.empty()) reason = measure(record, scene, resolved, pictured);
        if (!reason.empty()) record["failed"] = reason;
        ++(reason.empty() ? outcome_.measured : outcome_.failed);
        write_record(runs_, record);
        return record;
    }

    /// Where the run is in its plan, and how to draw it.
    void place(Json& record, const Run& run, std::size_t order, const RunScene& scene) const {
        record["plan_id"] = plan_id_;
        record["order"] = order;
        record["command"] = render_command(plan_, run, scene.overrides);
        record["maps"] = std::filesystem::absolute(options_.output / "maps").string();
    }

    /// A plan that has changed elsewhere may have the run in another place, and the folder may have
    /// been moved.
    Json renamed(Json known, const Run& run, std::size_t order, const RunScene& scene) {
        ++outcome_.known;
        const Json before = known;
        known["plan"] = plan_.title;
        known["published_fps"] = describe_run(plan_, run, {})["published_fps"];
        known["published_on"] = plan_.published_on;
        place(known, run, order, scene);
        if (known != before) write_record(runs_, known);
        return known;
    }

    /// Why it could not be measured; empty if it was.
    std::string measure(Json& record, const RunScene& scene, const Run& run, bool pictured) {
        try {
            measure_all(record, scene, run, pictured);
            return "";
        } catch (const InputError& error) {
            return error.what();
        } catch (const UsageError& error) {
            return error.what();
        }
    }

    void measure_all(Json& record, const RunScene& scene, const Run& run, bool pictured) {
        const RenderOptions options = scenes_.render_options(run);
        const AllowedThreads allowed(run.threads);
        MeasuredRun measured(scene.scene, options);
        const RunTime time = measured.time(plan_.repeats, plan_.repeat_seconds, record["trace"]);
        const JudgedRun judged = scenes_.judge(
            scene, run,
            pictured ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{});
        record["map_width"] = judged.map.width;
        record["map_height"] = judged.map.height;
        add_time(record, time, run.threads);
        add_counts(record, measured.count(), search_cost(judged.film));
        add_error(record, judged.error);
        if (!pictured) return;
        const int side = plan_.pictures.side;
        record["picture"] = data_uri(thumbnail(judged.film, side));
        const Window& window = judged.film.window;
        record["error_picture"] =
            data_uri(error_thumbnail(judged.error, window.width(), window.height(), side));
    }

    const Plan& plan_;
    const SweepOptions& options_;
    std::filesystem::path runs_;
    std::string plan_id_;
    RunScenes scenes_;
    SweepOutcome outcome_;
};

}  // namespace

SweepOutcome run_sweep(const Plan& plan, const SweepOptions& options) {
    return Sweeper(plan, options).run();
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw OutputError(folder.string(), error ? error.message() : "not a folder");
}

}  // namespace quadrel::sweep
