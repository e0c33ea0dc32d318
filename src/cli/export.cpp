// quadrel export: what other programs take over.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/quiet.hpp"
#include "cli/snippets.hpp"
#include "cli/verbs.hpp"

namespace quadrel::cli {
namespace {

struct ExportArguments {
    std::string language, pattern, output;
    bool snippets = false;
};

ExitCode run_export(const ExportArguments& arguments) {
    if (arguments.snippets != arguments.pattern.empty())
        throw UsageError("export: expected --snippets or --pattern");
    if (arguments.snippets) return print_snippets(arguments.language);
    return write_pattern(arguments.pattern, arguments.output);
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("export", "shader code that takes exact values out of an engine");
    const auto a = std::make_shared<ExportArguments>();
    verb->add_flag("--snippets", a->snippets,
                   "print functions that pack a float's 32 bits into codes of 8, 10 or 16 bits, "
                   "for compare --decode");
    verb->add_option("--language", a->language, "of the snippets; otherwise all")
        ->type_name("glsl|glsl-es|hlsl|wgsl");
    verb->add_option("--pattern", a->pattern,
                     "write what pattern_bits of the snippets gives, as an EXR of this size")
        ->type_name("WxH");
    verb->add_option("-o,--output", a->output, "the pattern's file")->type_name("OUT.exr");
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_export(*a); }; });
}

}  // namespace quadrel::cli
