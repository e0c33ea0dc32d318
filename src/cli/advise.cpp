// quadrel advise: the cheapest search that is exact enough on a scene's map.
#include "sweep/advise.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/quiet.hpp"
#include "cli/verbs.hpp"

namespace quadrel::cli {
namespace {

struct AdviseArguments {
    std::string scene, error = "0.5texel", angles = "0..75";
    std::vector<std::string> overrides, plugins;
    double budget = 0, percent = 99;
    int side = 96, rows = 12;
    bool json = false;
};

ExitCode run_advise(const AdviseArguments& arguments) {
    load_plugins(arguments.plugins);
    sweep::Question question;
    question.scene = arguments.scene;
    question.overrides = arguments.overrides;
    question.texels = sweep::parse_texels(arguments.error);
    question.angles = sweep::parse_angles(arguments.angles);
    question.percent = arguments.percent;
    if (arguments.budget > 0) question.budget = arguments.budget;
    question.side = arguments.side;
    ProgressBar bar;
    question.progress = [&bar](std::size_t done, std::size_t all, const std::string& name) {
        bar.show(static_cast<double>(done) / static_cast<double>(all), name);
    };
    const sweep::Advice advice = sweep::advise(question);
    bar.clear();
    if (arguments.json)
        print_json(sweep::advice_json(question, advice).dump(2) + "\n");
    else
        print(sweep::advice_text(question, advice, static_cast<std::size_t>(arguments.rows)));
    return ExitCode::ok;
}

}  // namespace

void add_advise(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "advise", "name the cheapest search whose hits are near enough to the true ones");
    const auto a = std::make_shared<AdviseArguments>();
    verb->add_option("scene", a->scene, "scene file, or the name of an installed scene")
        ->required();
    verb->add_option("--error", a->error, "distance from the true hit that is allowed")
        ->type_name("TEXELS")
        ->capture_default_str();
    verb->add_option("--percent", a->percent, "share of the pixels that have to keep it")
        ->check(CLI::Range(1.0, 100.0))
        ->capture_default_str();
    verb->add_option("--angles", a->angles, "between view and normal, degrees")
        ->type_name("A..B[:STEP]|A,B,...")
        ->capture_default_str();
    verb->add_option("--budget", a->budget, "look-ups per fragment that are allowed, on average")
        ->type_name("FETCHES")
        ->check(CLI::PositiveNumber);
    verb->add_option("-D,--define", a->overrides, "override a value of the scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--side", a->side, "pixels of the frames that are judged")
        ->check(CLI::Range(8, 1024))
        ->capture_default_str();
    verb->add_option("--rows", a->rows, "lines of each table")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    verb->add_flag("--json", a->json, "machine-readable: all searches, whatever --rows says");
    add_plugin_option(*verb, a->plugins);
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_advise(*a); }; });
}

}  // namespace quadrel::cli
