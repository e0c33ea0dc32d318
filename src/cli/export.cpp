// quadrel export: what other programs take over.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/quiet.hpp"
#include "cli/snippets.hpp"
#include "cli/verbs.hpp"

namespace quadrel::cli {
namespace {

struct ExportArguments {
    SnippetArguments snippets;
    std::string language, output;
};

ExitCode run_export(const ExportArguments& arguments) {
    if (!arguments.snippets.given()) throw UsageError("export: expected --snippets or --pattern");
    return run_snippets(arguments.snippets, arguments.language, arguments.output);
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("export", "shader code that takes exact values out of an engine");
    const auto a = std::make_shared<ExportArguments>();
    add_snippet_options(*verb, a->snippets);
    verb->add_option("--language", a->language, "of the snippets; otherwise all")
        ->type_name("glsl|glsl-es|hlsl|wgsl");
    verb->add_option("-o,--output", a->output, "the pattern's file")->type_name("OUT.exr");
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_export(*a); }; });
}

}  // namespace quadrel::cli
