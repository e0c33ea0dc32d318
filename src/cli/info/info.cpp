// quadrel info: what a file holds.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/info/file_info.hpp"
#include "cli/verbs.hpp"
#include "text/printable.hpp"

namespace quadrel::cli {
namespace {

std::string inline_text(const Json& value) {
    if (value.is_string()) return printable(value.get<std::string>());
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Objects of plain values on one line: "name=R type=float min=0".
std::string row_text(const Json& row) {
    if (!row.is_object()) return inline_text(row);
    std::string text;
    for (const auto& [key, value] : row.items())
        text += fmt::format("{}{}={}", text.empty() ? "" : "  ", key, inline_text(value));
    return text;
}

std::string to_text(const Json& info) {
    std::string text;
    for (const auto& [key, value] : info.items()) {
        if (value.is_array() && !value.empty() && value[0].is_object()) {
            text += key + "\n";
            for (const Json& row : value) text += "  " + row_text(row) + "\n";
        } else if (value.is_object()) {
            text += key + "\n";
            for (const auto& [name, entry] : value.items())
                text += fmt::format("  {} = {}\n", printable(name), inline_text(entry));
        } else {
            text += fmt::format("{:<12}{}\n", key, inline_text(value));
        }
    }
    return text;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("info", "describe an EXR, an image, a mesh or a scene");
    struct Arguments {
        std::string file;
        ImageSelection selection;
        std::vector<std::string> plugins;
        bool json = false;
    };
    const auto a = std::make_shared<Arguments>();
    verb->add_option("file", a->file,
                     "EXR, image, mesh (OBJ, glTF), scene file or name of an installed scene")
        ->required();
    add_selection_options(*verb, a->selection);
    add_plugin_option(*verb, a->plugins);
    verb->add_flag("--json", a->json, "machine-readable, on standard output");
    verb->callback([a, &action] {
        action = [a] {
            load_plugins(a->plugins);
            const Json info = file_info(a->file, a->selection);
            if (a->json)
                print_json(info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
            else
                print(to_text(info));
            return ExitCode::ok;
        };
    });
}

}  // namespace quadrel::cli
