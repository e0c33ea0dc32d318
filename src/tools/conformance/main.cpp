// quadrel-conformance: exports scenes, has an implementation of OpenGL draw them, and explains
// every value that is not the reference's.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <tuple>

#include "conformance/cases.hpp"
#include "conformance/judge/judge.hpp"
#include "conformance/planted.hpp"
#include "conformance/report.hpp"
#include "conformance/rewrites.hpp"
#include "export/scene/export_scene.hpp"
#include "file/atomic_file.hpp"
#include "file/temporary_folder.hpp"
#include "gl/context/context.hpp"
#include "gl/context/renderer_choice.hpp"
#include "gl/scene/draw_scene.hpp"
#include "gl/scene/objects.hpp"
#include "quadrel/error.hpp"
#include "run_tool.hpp"
#include "text/printable.hpp"

namespace quadrel::conformance {
namespace {

struct Arguments {
    std::vector<std::string> rows, except, maps{"obstacles", "bricks", "dunes"};
    std::vector<int> angles{0, 45, 75, 85};
    int size = 256;
    int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    bool all = false, json = false, markdown = false, planted = false, quiet = false,
         resume = false;
    gl::RendererChoice renderer;
    std::string output, hardware;
    JudgeOptions judging;
    Bounds bounds;
};

bool is_json(const Arguments& arguments) {
    return arguments.json || std::string_view(arguments.output).ends_with(".json");
}

struct Drawn {
    gl::ExportedScene scene;
    Scene source;
};

/// The row's scene as its export has it. Throws UsageError where it cannot be exported.
Drawn exported(const Case& what, const std::string& hardware, int threads) {
    Scene scene = scene_of(what, hardware);
    const TemporaryFolder work;
    const std::filesystem::path folder = work.path() / "export";
    SceneExport options;
    options.reference = false;
    options.threads = threads;
    options.baking_limit = std::numeric_limits<double>::infinity();
    export_scene(scene, options, folder);
    return {gl::read_exported_scene(folder), std::move(scene)};
}

/// Of the height map or the layers that the first material looks up; 0 where there are none.
TexelSize texel_size(const gl::ExportedScene& scene) {
    for (const char* const map : {"height", "layers"})
        for (const gl::ExportedSampler& sampler : scene.materials.front().samplers)
            if (sampler.uniform.find(map) != std::string::npos) {
                const gl::TextureLevel& level = scene.textures[sampler.texture].levels.front();
                return {1.0 / level.width, 1.0 / level.height};
            }
    return {};
}

CaseReport run_case(const Case& what, const std::string& hardware, const JudgeOptions& judging,
                    gl::Programs& programs) {
    CaseReport report{what.row, what.map, what.angle, {}, {}, {}};
    std::optional<Drawn> drawn;
    try {
        drawn = exported(what, hardware, judging.threads);
    } catch (const UsageError& error) {
        report.refusal = error.what();
        return report;
    } catch (const std::runtime_error& error) {  // and not "there is no OpenGL"
        report.failure = error.what();
        return report;
    }
    JudgeOptions options = judging;
    options.texel = texel_size(drawn->scene);
    options.implicit_in_loops = has_implicit_look_ups_in_loops(drawn->scene);
    const auto redraw = [&](Verdict verdict, gl::ExportedScene (*other)(gl::ExportedScene)) {
        options.redraws.push_back(
            {verdict, [&, other] { return gl::draw_scene(other(drawn->scene), {}, programs); }});
    };
    if (has_mixes(drawn->scene)) redraw(Verdict::perturbed, with_blends);
    redraw(Verdict::unordered, with_comparisons);
    redraw(Verdict::defect, with_sizes_of_level_0);
    redraw(Verdict::defect, with_whole_levels);
    try {
        report.groups = judge(drawn->source, gl::draw_scene(drawn->scene, {}, programs), options);
    } catch (const gl::TooLarge& error) {
        report.refusal = error.what();
    } catch (const std::runtime_error& error) {
        report.failure = error.what();
    }
    return report;
}

std::uint64_t unexplained(const std::vector<GroupReport>& groups) {
    std::uint64_t sum = 0;
    for (const GroupReport& group : groups) sum += count_of(group.counts, Verdict::unexplained);
    return sum;
}

/// Whether each planted error that a row has room for leaves something unexplained.
bool run_planted(const Arguments& arguments, const std::string& hardware) {
    bool all_found = true;
    for (const std::string& row : arguments.rows) {
        const Case what{row, arguments.maps.front(), arguments.angles.front(), arguments.size};
        for (const PlantedError& error : planted_errors()) {
            Drawn drawn = exported(what, hardware, 0);
            if (!error.plant(drawn.scene)) continue;
            JudgeOptions options = arguments.judging;
            options.texel = texel_size(drawn.scene);
            const std::uint64_t count =
                unexplained(judge(drawn.source, gl::draw_scene(drawn.scene), options));
            std::cout << row << ": " << error.name << ": "
                      << (count > 0 ? std::to_string(count) + " unexplained" : "not found")
                      << std::endl;
            all_found &= count > 0;
        }
    }
    return all_found;
}

/// Rows side by side, each by a context of its own, in which its cases share their programs.
class Workers {
  public:
    /// Cases that are `known` are taken as they are where they were drawn. `save` gets all that is
    /// known after each row.
    Workers(const Arguments& arguments, const std::string& hardware,
            const std::vector<CaseReport>& known, std::function<void(std::vector<CaseReport>)> save)
        : arguments_(arguments),
          hardware_(hardware),
          save_(std::move(save)),
          reports_(arguments.rows.size()),
          done_(arguments.rows.size(), false) {
        if (arguments.jobs > 1) judging_.threads = 1;
        for (const CaseReport& one : known)
            if (one.failure.empty()) known_[{one.row, one.map, one.angle}] = one;
    }

    /// The reports in the order of the rows.
    std::vector<CaseReport> run() {
        // Made one after the other, by what the environment says; they end when all is done.
        std::vector<gl::Context> contexts;
        for (int i = 0; i < arguments_.jobs; ++i) {
            contexts.push_back(gl::chosen_context(arguments_.renderer));
            contexts.back().release();
        }
        {
            std::vector<std::jthread> threads;
            for (const gl::Context& context : contexts)
                threads.emplace_back([this, &context] { work_by(context); });
        }
        if (failure_) std::rethrow_exception(failure_);
        return finished();
    }

  private:
    void work_by(const gl::Context& context) {
        try {
            context.make_current();
            work();
            context.release();
        } catch (...) {
            fail();
        }
    }

    void work() {
        for (std::size_t row = next_++; row < reports_.size(); row = next_++) {
            gl::Programs programs;
            for (const std::string& map : arguments_.maps)
                for (const int angle : arguments_.angles)
                    reports_[row].push_back(
                        report_of({arguments_.rows[row], map, angle, arguments_.size}, programs));
            const std::lock_guard lock(mutex_);
            done_[row] = true;
            if (save_) save_(finished());
        }
    }

    CaseReport report_of(const Case& what, gl::Programs& programs) {
        const auto known = known_.find({what.row, what.map, what.angle});
        if (known != known_.end()) return known->second;
        const auto begin = std::chrono::steady_clock::now();
        CaseReport report = run_case(what, hardware_, judging_, programs);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        if (!arguments_.quiet) {
            const std::lock_guard lock(mutex_);
            std::cerr << what.row << ' ' << what.map << ' ' << what.angle << ' '
                      << std::lround(1000 * taken.count()) << " ms\n";
        }
        return report;
    }

    /// Of the rows that are done, in their order.
    std::vector<CaseReport> finished() const {
        std::vector<CaseReport> all;
        for (std::size_t row = 0; row < reports_.size(); ++row)
            if (done_[row]) all.insert(all.end(), reports_[row].begin(), reports_[row].end());
        return all;
    }

    void fail() {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        next_ = reports_.size();
    }

    const Arguments& arguments_;
    const std::string& hardware_;
    std::function<void(std::vector<CaseReport>)> save_;
    JudgeOptions judging_ = arguments_.judging;
    std::map<std::tuple<std::string, std::string, int>, CaseReport> known_;
    std::vector<std::vector<CaseReport>> reports_;
    std::vector<bool> done_;
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr failure_;
};

void write(const Arguments& arguments, const Report& report) {
    const std::string text = is_json(arguments)   ? to_json(report).dump(2) + "\n"
                             : arguments.markdown ? to_markdown(report)
                                                  : to_text(report);
    if (arguments.output.empty()) {
        std::cout << text << std::flush;
        if (!std::cout) throw OutputError("standard output", "could not be written");
        return;
    }
    AtomicFile file(arguments.output);
    file.write(text.data(), text.size());
    file.commit();
}

Report run_cases(const Arguments& arguments, const std::string& hardware) {
    Report report{gl::gl_string(GL_RENDERER),
                  gl::gl_string(GL_VERSION),
                  hardware,
                  arguments.judging.limits,
                  arguments.size,
                  arguments.judging.most_ranged,
                  {}};
    std::vector<CaseReport> known;
    if (arguments.resume && std::filesystem::exists(arguments.output)) {
        Report before = read_report(arguments.output);
        known.swap(before.cases);
        if (to_json(before) != to_json(report))
            throw UsageError(
                fmt::format("--resume: {} is of {}, hardware {}, limits {}, size {} "
                            "and {} ranges, expected the same as here",
                            printable(arguments.output), before.renderer, before.hardware,
                            before.limits, before.size, before.most_ranged));
    }
    std::function<void(std::vector<CaseReport>)> save;
    if (arguments.resume)
        save = [&](std::vector<CaseReport> cases) {
            report.cases = std::move(cases);
            write(arguments, report);
        };
    report.cases = Workers(arguments, hardware, known, save).run();
    return report;
}

void check(Arguments& arguments) {
    const std::vector<std::string> known = all_rows();
    if (arguments.all == !arguments.rows.empty())
        throw UsageError(arguments.all ? "--all and rows: expected one of them"
                                       : "what is to be judged: rows, or --all");
    for (const std::vector<std::string>& named : {arguments.rows, arguments.except})
        for (const std::string& row : named)
            if (std::ranges::count(known, row) == 0)
                throw UsageError("no row is called " + printable(row) +
                                 "; quadrel list scenes names them, as rows/linear");
    for (const std::string& map : arguments.maps) find_map(map);
    if (arguments.resume && (arguments.output.empty() || !is_json(arguments)))
        throw UsageError("--resume: expected an output as JSON to go on with (-o FILE.json)");
    if (arguments.all) arguments.rows = known;
    std::erase_if(arguments.rows, [&](const std::string& row) {
        return std::ranges::count(arguments.except, row) != 0;
    });
}

bool run(Arguments& arguments) {
    check(arguments);
    const gl::Context context = gl::chosen_context(arguments.renderer);
    const std::string hardware =
        arguments.hardware.empty() ? hardware_of(gl::gl_string(GL_RENDERER)) : arguments.hardware;
    if (arguments.planted) return run_planted(arguments, hardware);
    const Report report = run_cases(arguments, hardware);
    write(arguments, report);
    const std::vector<std::string> lines = complaints(report, arguments.bounds);
    for (const std::string& line : lines) std::cerr << "quadrel-conformance: " << line << '\n';
    return lines.empty();
}

void add_options(CLI::App& app, Arguments& a) {
    const CLI::Range share(0.0, 1.0);
    app.add_option("rows", a.rows, "installed scenes of one row each, as linear");
    app.add_flag("--all", a.all, "all rows");
    app.add_option("--except", a.except, "rows that are not judged");
    app.add_option("--maps", a.maps, "obstacles, bricks, dunes")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--angles", a.angles, "degrees")
        ->delimiter(',')
        ->check(CLI::Range(0, 89))
        ->capture_default_str();
    app.add_option("--size", a.size, "pixels a side")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app.add_option("--jobs", a.jobs, "rows that are judged side by side")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--hardware", a.hardware, "the reference's; else by the renderer's name");
    app.add_option("--limits", a.judging.limits,
                   "what an implementation may give, as render has it")
        ->capture_default_str();
    app.add_option("--most-ranged", a.judging.most_ranged,
                   "quads of a case whose ranges of hits, shadows and occlusion are computed, each")
        ->capture_default_str();
    app.add_option("--most-perturbed", a.bounds.perturbed, "share of a group's pixels that may be")
        ->check(share)
        ->capture_default_str();
    app.add_option("--most-legal", a.bounds.legal, "share of a group's pixels that may be")
        ->check(share)
        ->capture_default_str();
    app.add_option("--most-open", a.bounds.open, "share of a group's pixels that may be")
        ->check(share)
        ->capture_default_str();
    app.add_option("--most-left", a.bounds.left, "share of a group's pixels that may be")
        ->check(share)
        ->capture_default_str();
    app.add_flag("--json", a.json, "as JSON, with every case");
    app.add_flag("--markdown", a.markdown, "the table in Markdown");
    app.add_option("-o,--output", a.output, "into a file; .json: as JSON")->type_name("FILE");
    app.add_flag("--resume", a.resume,
                 "write the output after each row, and take from it the cases that it has already; "
                 "others that it has are dropped");
    gl::add_renderer_options(app, a.renderer);
    app.add_flag(
        "--planted", a.planted,
        "whether errors that are planted into the rows' shaders are found, on the first map "
        "at the first angle");
    app.add_flag("--quiet", a.quiet, "do not tell which case is drawn");
    app.footer(
        "Exit codes: 0 everything is explained; 1 something is not, more is merely explained than "
        "may be, or nothing could be drawn; 2 bad command line; 3 there is no "
        "OpenGL to ask; 5 output could not be written.");
}

}  // namespace
}  // namespace quadrel::conformance

int main(int argc, char** argv) {
    using namespace quadrel::conformance;
    CLI::App app("Judges an implementation of OpenGL by what it draws of each row",
                 "quadrel-conformance");
    Arguments arguments;
    add_options(app, arguments);
    return quadrel::run_tool(app, argc, argv, [&] { return run(arguments); });
}
