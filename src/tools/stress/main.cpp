// quadrel-stress: scenes that are known to be hard, and random ones from tame to absurd. Looks for
// crashes, hangs, numbers that are none and statuses without a reason, and says how far floats
// depart from doubles and from certified hits, and over which range they stay with them.
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>

#include "file/temporary_folder.hpp"
#include "quadrel/error.hpp"
#include "run_tool.hpp"
#include "stress/log.hpp"
#include "stress/planted.hpp"
#include "stress/ranges/ranges.hpp"
#include "stress/report.hpp"
#include "stress/scenes/lists.hpp"
#include "stress/workers.hpp"

namespace quadrel::stress {
namespace {

struct Arguments {
    std::uint64_t seed = 1, scenes = 1000;
    std::size_t lists = 1;
    std::string only, folder, plot, ranges, log;
    bool list = false, planted = false;
    int processes = 1;
    double seconds = 20, look_ups = usual_look_ups;
};

/// In a process of its own: what forks later has no threads that a library has started.
void write_maps_apart(const std::filesystem::path& folder) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            write_maps(folder);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "quadrel-stress: %s\n", error.what());
            _exit(1);
        }
        _exit(0);
    }
    int status = 1;
    waitpid(child, &status, 0);
    if (status != 0) throw OutputError(folder.string(), "the maps could not be written");
}

/// Runs a job with a count of scenes on a terminal.
template <class Done>
void run_shown(const Job& job, const Arguments& arguments, const std::filesystem::path& folder,
               const Done& done) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::uint64_t finished = 0;
    run_scenes(job, {arguments.processes, arguments.seconds, arguments.look_ups, folder},
               [&](const StressScene& scene, const SceneResult& result) {
                   done(scene, result);
                   if (terminal && ++finished % 50 == 0)
                       std::cerr << '\r' << finished << " of " << job.count() << " scenes "
                                 << std::flush;
               });
    if (terminal) std::cerr << '\r' << std::string(40, ' ') << '\r';
}

/// The results that the log has of a job's scenes, which are left out of it then.
void take_known(const ResultLog& log, Job& job, Report& report) {
    for (const auto& [scene, result] : log.known()) {
        const auto number = job.number_of(scene);
        if (!number) continue;
        job.leave_out(*number);
        report.add(scene, result);
    }
}

bool run_job(const Arguments& arguments, const std::filesystem::path& folder, ResultLog* log) {
    Job job(arguments.seed, arguments.scenes, arguments.lists);
    Report report;
    if (log != nullptr) take_known(*log, job, report);
    run_shown(job, arguments, folder, [&](const StressScene& scene, const SceneResult& result) {
        report.add(scene.name, result);
        if (log != nullptr) log->add(scene.name, result);
    });
    std::cout << report.to_text();
    return !report.has_errors();
}

bool run_ranges(const Arguments& arguments, const std::filesystem::path& folder) {
    std::vector<RangeTable> tables;
    Report report;
    for (const std::string room : {"frame", "trace"}) {
        if (arguments.ranges != "all" && arguments.ranges != room) continue;
        std::map<std::string, SceneResult> results;
        run_shown(Job(range_scenes(room)), arguments, folder,
                  [&](const StressScene& scene, const SceneResult& result) {
                      results[scene.name] = result;
                      report.add(scene.name, result);
                  });
        tables.push_back(range_table(room, results));
        std::cout << to_text(tables.back()) << std::endl;
    }
    if (report.has_errors()) std::cout << report.to_text();
    if (!arguments.plot.empty()) {
        std::ofstream file(arguments.plot, std::ios::binary);
        file << range_plot(tables) << std::flush;
        if (!file) throw OutputError(arguments.plot, "could not be written");
    }
    return !report.has_errors();
}

/// Whether each planted error is found.
bool run_planted(Arguments arguments, const std::filesystem::path& folder) {
    const std::vector<StressScene> scenes = planted_scenes();
    std::size_t found = 0;
    arguments.seconds = 2;
    run_shown(Job(scenes), arguments, folder,
              [&](const StressScene& scene, const SceneResult& result) {
                  const bool told =
                      std::any_of(result.findings.begin(), result.findings.end(),
                                  [&](const Finding& f) { return f.kind == scene.planted; });
                  found += told;
                  if (!told) std::cout << "not found: " << scene.name << '\n';
              });
    if (found == scenes.size()) std::cout << "planted errors: all " << found << " found\n";
    return found == scenes.size();
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        throw OutputError(folder.string(), error ? error.message() : "not a folder");
}

/// Prints a scene, or writes and judges it.
bool replay(const Arguments& arguments) {
    const StressScene scene = scene_by_name(arguments.seed, arguments.only);
    if (arguments.folder.empty()) {
        std::cout << scene.document.dump(2) << '\n';
        return true;
    }
    make_folder(arguments.folder);
    write_scene(arguments.folder, scene);
    Report report;
    report.add(scene.name, check_scene(arguments.folder, scene, {0, arguments.look_ups}));
    std::cout << report.to_text();
    return !report.has_errors();
}

/// What is asked for is done, or refused.
void check(const Arguments& arguments) {
    if (!(arguments.seconds > 0)) throw UsageError("--seconds: found no number above 0");
    if (!(arguments.look_ups > 0)) throw UsageError("--look-ups: found no number above 0");
    if (!arguments.plot.empty() && arguments.ranges.empty())
        throw UsageError("--plot: found no --ranges, expected it: it is what is plotted");
    if (!arguments.folder.empty() && arguments.only.empty())
        throw UsageError("-o: found no --only, expected the scene to write");
    const int tasks = int(arguments.list) + int(!arguments.only.empty()) + int(arguments.planted) +
                      int(!arguments.ranges.empty());
    if (tasks > 0 && !arguments.log.empty())
        throw UsageError("--log: found another task, expected scenes to run");
    if (tasks > 1)
        throw UsageError("found several of --list, --only, --planted and --ranges, expected one");
}

bool run(const Arguments& arguments) {
    check(arguments);
    if (arguments.list) {
        for (const StressScene& scene : listed_scenes()) std::cout << scene.name << '\n';
        return true;
    }
    if (!arguments.only.empty()) return replay(arguments);
    std::optional<ResultLog> log;
    if (!arguments.log.empty()) log.emplace(arguments.log, arguments.seed, arguments.look_ups);
    const TemporaryFolder folder("quadrel-stress");
    setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
    write_maps_apart(folder.path());
    if (arguments.planted) return run_planted(arguments, folder.path());
    return arguments.ranges.empty() ? run_job(arguments, folder.path(), log ? &*log : nullptr)
                                    : run_ranges(arguments, folder.path());
}

void add_options(CLI::App& app, Arguments& a) {
    app.add_option("--scenes", a.scenes, "random scenes")
        ->capture_default_str()
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1000000000000}));
    app.add_option("--seed", a.seed, "of the random scenes")->capture_default_str();
    app.add_option("--lists", a.lists, "every N-th of the listed scenes; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0, 1000000));
    app.add_flag("--list", a.list, "print the names of the listed scenes");
    app.add_option("--only", a.only,
                   "print one scene as JSON: the number of a random one, or a listed one's name")
        ->type_name("SCENE");
    app.add_option("-o", a.folder,
                   "with --only: write it with its maps and mesh into a folder, and judge it")
        ->type_name("FOLDER");
    app.add_option("--ranges", a.ranges,
                   "instead: over which range each frame or trace stays within half a texel")
        ->check(CLI::IsMember({"frame", "trace", "all"}));
    app.add_option("--plot", a.plot, "with --ranges: the same as a picture")->type_name("OUT.svg");
    app.add_flag("--planted", a.planted, "instead: whether errors that are planted are found");
    app.add_option("-t,--processes", a.processes, "at once")
        ->capture_default_str()
        ->check(CLI::Range(1, 1024));
    app.add_option("--seconds", a.seconds,
                   "of processor time that a scene may take; ten times that on the clock")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--look-ups", a.look_ups,
                   "that drawing a scene once may take; of one that takes more a part is drawn")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--log", a.log,
                   "keep the results in a file, and run no scene again that it has: of one build, "
                   "which is not checked")
        ->type_name("FILE");
    app.footer(
        "Exit codes: 0 nothing found; 1 something was found; 2 bad command line; 3 bad input; 4 an "
        "error of the program; 5 output could not be written.");
}

}  // namespace
}  // namespace quadrel::stress

int main(int argc, char** argv) {
    using namespace quadrel::stress;
    CLI::App app("Scenes from tame to absurd: what breaks, and how far floats can be trusted",
                 "quadrel-stress");
    Arguments arguments;
    add_options(app, arguments);
    return quadrel::run_tool(app, argc, argv, [&] { return run(arguments); });
}
