#include "cli/verbs.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>

#include "cli/common/examples.hpp"
#include "cli/explain/exit_codes.hpp"

namespace quadrel::cli {
namespace {

struct Verb {
    std::string_view name;
    void (*add)(CLI::App&, Action&);
};

constexpr Verb verbs[] = {{"render", add_render},
                          {"compare", add_compare},
                          {"list", add_list},
                          {"info", add_info},
                          {"probe", add_probe},
                          {"sheet", add_sheet},
                          {"mips", add_mips},
                          {"bake", add_bake},
                          {"explain", add_explain},
                          {"sweep", add_sweep},
                          {"advise", add_advise},
                          {"errors", add_errors},
                          {"export", add_export},
                          {"view", add_view},
                          {"join", add_join},
                          {"man", add_man},
                          {"completion", add_completion}};

}  // namespace

bool is_verb(std::string_view name) {
    return std::any_of(std::begin(verbs), std::end(verbs),
                       [&](const Verb& verb) { return verb.name == name; });
}

std::unique_ptr<CLI::App> make_program(Action& action, VerbsAdded added, std::string_view only) {
    auto app = std::make_unique<CLI::App>("CPU reference rasterizer for relief mapping", "quadrel");
    app->set_version_flag("-V,--version", "quadrel " QUADREL_VERSION);
    app->require_subcommand(1);
    app->footer(exit_code_help());
    for (const Verb& verb : verbs)
        if (added == VerbsAdded::all || (added == VerbsAdded::one && verb.name == only))
            verb.add(*app, action);
    add_examples(*app);
    return app;
}

}  // namespace quadrel::cli
