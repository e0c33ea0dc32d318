// quadrel explain: the documentation of a name.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "cli/explain/explain_key.hpp"
#include "cli/explain/explanations.hpp"
#include "cli/verbs.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

struct ExplainArguments {
    std::vector<std::string> words, plugins;
};

/// The name or path that is nearest; empty if none is near.
std::string nearest_name(const std::string& word) {
    const std::string name = nearest_word(word, explained_names()), path = nearest_path(word);
    if (name.empty() || path.empty()) return name + path;
    return edit_distance(word, path) <= edit_distance(word, name) ? path : name;
}

[[noreturn]] void reject(const std::string& word) {
    const std::string nearest = nearest_name(word);
    throw UsageError("explain: found \"" + word +
                     "\", expected a scene key, channel, stage, parameter, preset, kind of baked "
                     "map or exit code" +
                     (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

ExitCode run_explain(const ExplainArguments& arguments) {
    load_plugins(arguments.plugins);
    std::string text;
    for (const std::string& word : arguments.words) {
        const std::vector<std::string> texts = explanations(word);
        if (texts.empty()) reject(word);
        for (const std::string& one : texts) text += (text.empty() ? "" : "\n") + one;
    }
    print(text);
    return ExitCode::ok;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "explain", "document a scene key, channel, stage, parameter, preset or exit code");
    const auto a = std::make_shared<ExplainArguments>();
    verb->add_option("names", a->words, "as material.relief.depth, hit.status, linear, 75")
        ->required();
    add_plugin_option(*verb, a->plugins);
    verb->callback([a, &action] { action = [a] { return run_explain(*a); }; });
}

}  // namespace quadrel::cli
