// quadrel sweep: run time against error, over all runs of a plan.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/quiet.hpp"
#include "cli/verbs.hpp"
#include "sweep/report/results.hpp"
#include "sweep/sweep.hpp"

namespace quadrel::cli {
namespace {

struct SweepArguments {
    std::string plan, output, task;
    std::vector<std::string> merged, plugins;
    bool table = false, partial = false;
};

void check_arguments(const SweepArguments& arguments) {
    if (arguments.plan.empty() == arguments.merged.empty())
        throw UsageError(arguments.plan.empty()
                             ? "found no plan, expected one or --merge with folders of sweeps"
                             : "found a plan and --merge, expected one of them");
    if (!arguments.task.empty() && arguments.plan.empty())
        throw UsageError("found --task with --merge, expected it with a plan");
    if (arguments.partial && arguments.merged.empty())
        throw UsageError("found --partial with a plan, expected it with --merge");
}

void finish(const SweepArguments& arguments, const std::string& title,
            const std::vector<Json>& records) {
    sweep::write_results(arguments.output, title, records);
    if (arguments.table) print(sweep::frames_table(records));
    say_written(std::filesystem::path(arguments.output) / "page.html");
}

ExitCode merge(const SweepArguments& arguments) {
    const sweep::MergedSweeps merged = sweep::merge_sweeps(
        {arguments.merged.begin(), arguments.merged.end()}, arguments.output, arguments.partial);
    std::string title = merged.records.front().value("plan", "sweep");
    if (!merged.lacking.empty()) {
        say("quadrel: warning: joined " + merged.lacking);
        title += ", incomplete: " + merged.lacking;
    }
    finish(arguments, title, merged.records);
    return ExitCode::ok;
}

void say_failures(const sweep::SweepOutcome& outcome) {
    if (outcome.failed == 0) return;
    say(fmt::format("quadrel: warning: {} of {} runs could not be measured; the first: {}",
                    outcome.failed, outcome.records.size(), [&] {
                        for (const Json& record : outcome.records)
                            if (record.contains("failed"))
                                return record["algorithm"].get<std::string>() + ": " +
                                       record["failed"].get<std::string>();
                        return std::string();
                    }()));
}

ExitCode run_sweep(const SweepArguments& arguments) {
    check_arguments(arguments);
    CommandFiles files;
    for (const char* name : {"results.json", "results.csv", "page.html", "part.json"})
        files.add_output("-o", std::filesystem::path(arguments.output) / name);
    load_plugins(arguments.plugins);
    if (arguments.plan.empty()) return merge(arguments);
    const Task task = parse_task(arguments.task);
    const sweep::Plan plan = sweep::read_plan(arguments.plan);
    files.check();
    ProgressBar bar;
    sweep::SweepOptions options{arguments.output, task.number, task.of, QUADREL_VERSION, {}};
    options.progress = [&bar](std::size_t done, std::size_t all, const std::string& name) {
        bar.show(static_cast<double>(done) / static_cast<double>(all), name);
    };
    const sweep::SweepOutcome outcome = sweep::run_sweep(plan, options);
    bar.clear();
    tell(fmt::format("quadrel: {} runs measured, {} known from before, {} failed", outcome.measured,
                     outcome.known, outcome.failed));
    say_failures(outcome);
    finish(arguments, plan.title, outcome.records);
    const bool nothing = outcome.failed > 0 && outcome.measured + outcome.known == 0;
    return nothing ? ExitCode::input : ExitCode::ok;
}

}  // namespace

void add_sweep(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "sweep", "measure run time against error over a plan of scenes, maps, views and searches");
    const auto a = std::make_shared<SweepArguments>();
    verb->add_option("plan", a->plan, "what to measure, as JSON (bench/README.md has the format)")
        ->type_name("PLAN.json");
    verb->add_option("-o,--output", a->output,
                     "folder for results.csv, results.json, page.html and plots; runs that it has "
                     "are not measured again")
        ->type_name("DIR")
        ->required();
    verb->add_option("--task", a->task, "only every N-th run, from the I-th on, counted from 1")
        ->type_name("I/N");
    verb->add_option("--merge", a->merged, "join the runs of these folders instead")
        ->type_name("DIR...");
    verb->add_flag("--partial", a->partial,
                   "with --merge: join what is there of a plan whose runs are not all there");
    verb->add_flag("--table", a->table,
                   "also print frames per second and errors as a Markdown table");
    add_plugin_option(*verb, a->plugins);
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_sweep(*a); }; });
}

}  // namespace quadrel::cli
