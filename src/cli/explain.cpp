// quadrel explain: the documentation of a name.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/console.hpp"
#include "cli/explanations.hpp"
#include "cli/plugins.hpp"
#include "cli/verbs.hpp"
#include "io/suggest.hpp"

namespace quadrel::cli {
namespace {

struct Arguments {
    std::vector<std::string> words, plugins;
};

[[noreturn]] void reject(const std::string& word) {
    const std::string nearest = nearest_word(word, explained_names());
    throw UsageError(
        "explain: found \"" + word + "\", expected " +
        (nearest.empty() ? "" : "\"" + nearest + "\" perhaps: ") +
        "a scene key, channel, stage, parameter, preset, kind of baked map or exit code");
}

ExitCode run_explain(const Arguments& arguments) {
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
    const auto a = std::make_shared<Arguments>();
    verb->add_option("names", a->words, "as material.relief.depth, hit.status, linear, 75")
        ->required();
    add_plugin_option(*verb, a->plugins);
    verb->callback([a, &action] { action = [a] { return run_explain(*a); }; });
}

}  // namespace quadrel::cli
