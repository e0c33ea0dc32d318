// quadrel list: what there is to choose from.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/console.hpp"
#include "cli/common/filtered_rows.hpp"
#include "cli/common/plugins.hpp"
#include "cli/explain/shader_reasons.hpp"
#include "cli/verbs.hpp"
#include "render/lists/rows.hpp"

namespace quadrel::cli {
namespace {

void print_rows(const ListRows& rows, bool json) {
    if (!json) {
        for (const ListRow& row : rows) print(row.text);
        return;
    }
    print_json(rows_json(rows));
}

struct ListArguments {
    bool json = false;
    std::vector<std::string> filter, plugins;
};

/// What is asked of a few, or by a program, says of stages whether they are shaders, too: that
/// takes three times as long as a list.
ExitCode run_list(const ListArguments& arguments, ListRows (*make)()) {
    load_plugins(arguments.plugins);
    ListRows rows = filtered_rows(make(), arguments.filter);
    if (make == algorithm_rows && (arguments.json || !arguments.filter.empty()))
        add_shader_reasons(rows);
    print_rows(rows, arguments.json);
    return ExitCode::ok;
}

std::shared_ptr<ListArguments> add_kind(CLI::App& list, const char* name, const char* meaning,
                                        ListRows (*make)(), Action& action) {
    CLI::App* kind = list.add_subcommand(name, meaning);
    const auto arguments = std::make_shared<ListArguments>();
    kind->add_option("words", arguments->filter, "only what has all of these words in its texts");
    kind->add_flag("--json", arguments->json, "machine-readable, on standard output");
    kind->callback([=, &action] { action = [=] { return run_list(*arguments, make); }; });
    return arguments;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
    CLI::App* list = app.add_subcommand("list", "list algorithms, channels, presets or scenes");
    list->require_subcommand(1);
    const auto algorithms =
        add_kind(*list, "algorithms", "every stage with its parameters", algorithm_rows, action);
    add_plugin_option(*list->get_subcommand("algorithms"), algorithms->plugins);
    add_kind(*list, "channels", "everything that an image can hold", channel_rows, action);
    add_kind(*list, "presets", "what engines ship, as choices of stages", preset_rows, action);
    add_kind(*list, "scenes", "the installed scenes and what they show", scene_rows, action);
}

}  // namespace quadrel::cli
