// quadrel probe: one pixel's quad, with everything that it goes through.
#include "quadrel/probe.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/arguments.hpp"
#include "cli/common/console.hpp"
#include "cli/common/injections.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/validators.hpp"
#include "cli/verbs.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

struct ProbeArguments {
    std::string scene, pixel, size, number = "float", isa = "scalar";
    std::vector<std::string> overrides, plugins, injected;
    bool json = false;
};

ExitCode run_probe(const ProbeArguments& arguments) {
    load_plugins(arguments.plugins);
    const Pixel pixel = parse_pixel("--pixel", arguments.pixel);
    const Scene scene = load_scene(arguments.scene, with_size(arguments.overrides, arguments.size));
    say_notes(scene.notes);
    const ProbeReport report = probe(scene, pixel.x, pixel.y, arguments.number, arguments.isa,
                                     read_injections(arguments.injected));
    arguments.json ? print_json(to_json(report)) : print(to_text(report));
    return ExitCode::ok;
}

}  // namespace

void add_probe(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("probe", "re-run one pixel's quad and print all that it goes through");
    const auto a = std::make_shared<ProbeArguments>();
    verb->add_option("scene", a->scene, "scene file, or the name of an installed scene")
        ->required();
    verb->add_option("--pixel", a->pixel, "image coordinates from the top-left")
        ->type_name("X,Y")
        ->required();
    verb->add_option("-D,--define", a->overrides, "override a value of the scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--size", a->size, "image size in pixels")->type_name("WxH");
    verb->add_option("--number", a->number,
                     "number type of the shading; double runs on scalar alone")
        ->check(one_word_of(std::vector<std::string>{"float", "double"}))
        ->capture_default_str();
    verb->add_option("--isa", a->isa,
                     "instruction set; steps and look-ups are shown by float on scalar alone")
        ->check(one_word_of(
            std::vector<std::string>{"auto", "scalar", "sse4", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    add_plugin_option(*verb, a->plugins);
    add_inject_option(*verb, a->injected);
    verb->add_flag("--json", a->json, "machine-readable");
    verb->callback([a, &action] { action = [a] { return run_probe(*a); }; });
}

}  // namespace quadrel::cli
