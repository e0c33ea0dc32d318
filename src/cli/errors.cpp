// quadrel errors: how far what a scene draws is from the truth.
#include "quadrel/errors.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/plugins.hpp"
#include "cli/verbs.hpp"
#include "quadrel/error.hpp"
#include "quadrel/error_pictures.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

struct ErrorsArguments {
    std::string scene, size, window, maps;
    std::vector<std::string> overrides, plugins;
    ErrorOptions options;
    bool json = false;
};

/// Figures of nothing would look like those of a scene without errors.
void refuse_unjudged(const ErrorSummary& summary, const Scene& scene) {
    if (summary.judged > 0) return;
    const bool has_map = std::ranges::any_of(scene.materials, [](const Material& material) {
        return !material.noise && material.textures.contains("height");
    });
    const char* const found = summary.covered == 0 ? "nothing to judge: no pixel is covered"
                              : !has_map ? "nothing to judge: no material has a height map"
                                         : "nothing to judge: no covered pixel has a height map, a "
                                           "frame and a straight ray that cannot pass it";
    throw InputError(scene.file.string(), "", found, "objects in view whose heights are a map");
}

ExitCode run_errors(const ErrorsArguments& arguments) {
    CommandFiles files;
    files.add_output("--maps", arguments.maps);
    files.check_writable();
    check_output_kinds({{"--maps", ".png", arguments.maps}});
    load_plugins(arguments.plugins);
    ErrorOptions options = arguments.options;
    if (!arguments.window.empty()) options.window = parse_window("--window", arguments.window);
    const Scene scene = load_scene(arguments.scene, with_size(arguments.overrides, arguments.size));
    files.check();
    say_notes(scene.notes);
    Film film;
    if (!arguments.maps.empty()) options.film = &film;
    ErrorSummary summary;
    {
        ProgressBar bar;
        options.progress = [&bar](double share) { bar.show(share); };
        summary = measure_errors(scene, options);
    }
    refuse_unjudged(summary, scene);
    arguments.json ? print_json(to_json(summary)) : print(to_text(summary));
    if (!arguments.maps.empty()) {
        write_png(arguments.maps, error_sheet(film));
        say_written(arguments.maps);
    }
    return ExitCode::ok;
}

}  // namespace

void add_errors(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "errors", "render a scene's errors against the proven first hits and sum them up");
    const auto a = std::make_shared<ErrorsArguments>();
    verb->add_option("scene", a->scene, "scene file, or the name of an installed scene")
        ->required();
    verb->add_option("-D,--define", a->overrides, "override a value of the scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--size", a->size, "image size in pixels")->type_name("WxH");
    verb->add_option("--window", a->window,
                     "judge this part only: half-open, pixels from the top-left")
        ->type_name("X0,Y0,X1,Y1");
    verb->add_option("--number", a->options.number, "number type of the shading")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
    verb->add_option("--isa", a->options.isa, "instruction set; the bits do not depend on it")
        ->check(CLI::IsMember({"auto", "scalar", "sse4", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    verb->add_option("-t,--threads", a->options.threads,
                     "threads; 0: as many as there are CPUs, more are obeyed")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    verb->add_option("--worst", a->options.worst, "pixels to name of each kind of error")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    verb->add_option("--maps", a->maps, "write a PNG of the errors, a labelled map of each kind")
        ->type_name("OUT.png");
    add_plugin_option(*verb, a->plugins);
    verb->add_flag("--json", a->json, "machine-readable");
    verb->callback([a, &action] { action = [a] { return run_errors(*a); }; });
}

}  // namespace quadrel::cli
