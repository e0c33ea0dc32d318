// quadrel export: what other programs take over: stages as functions of shaders, snippets.
#include "export/export.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/validators.hpp"
#include "cli/snippets.hpp"
#include "cli/verbs.hpp"
#include "file/atomic_file.hpp"
#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"

namespace quadrel::cli {
namespace {

struct ExportArguments {
    SnippetArguments snippets;
    std::string stage, language, output;
    std::vector<std::string> parameters;
    int side = 1024, lights = 2;
    bool uniforms = false, list = false;
};

ExitCode list_stages() {
    for (const ExportRow& row : export_rows())
        print(fmt::format("{:<34} {}\n", row.room + "/" + row.id,
                          row.refusal.empty() ? "yes" : "no: " + row.refusal));
    return ExitCode::ok;
}

/// The stage of "linear" or "trace/linear".
const StageInfo& stage_of(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string id = slash == std::string::npos ? text : text.substr(slash + 1);
    const StageInfo* const stage = find_stage(id);
    if (stage != nullptr &&
        (slash == std::string::npos || text.substr(0, slash) == stage->text.room))
        return *stage;
    std::vector<std::string> known;
    for (const StageInfo& of : all_stages())
        known.push_back(slash == std::string::npos ? std::string(of.text.id)
                                                   : std::string(of.text.room) + "/" + of.text.id);
    const std::string nearest = nearest_word(text, known);
    throw UsageError(fmt::format("--stage: found \"{}\", expected {}", text,
                                 nearest.empty() ? "a stage of quadrel export --list"
                                                 : "\"" + nearest + "\" or another stage"));
}

/// A number where the text is one.
ParameterValue value_of(const std::string& text) {
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && stop == text.data() + text.size()) return number;
    return text;
}

void set_parameter(const StageInfo& stage, const std::string& text, void* params) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const ParameterText* const parameter = find_parameter(stage.text.id, name);
    if (equals == std::string::npos && parameter != nullptr)
        throw UsageError(fmt::format("-D: found \"{}\", expected {}=VALUE", text, text));
    if (parameter == nullptr) {
        std::vector<std::string> known;
        for (const ParameterText& of : stage.parameters) known.emplace_back(of.name);
        throw UsageError(
            fmt::format("-D: found \"{}\", expected {}=VALUE", text,
                        known.empty() ? "no parameter of this stage, NAME" : one_of(name, known)));
    }
    const ParameterValue value = value_of(text.substr(equals + 1));
    const std::optional<double> number = number_of(*parameter, value);
    if (!number)
        throw UsageError(fmt::format("-D {}: found {}, expected {}", name, text_of(value),
                                     expected_of(*parameter, value)));
    parameter->set(params, *number);
}

ExitCode run_export(const ExportArguments& arguments) {
    if (arguments.list) return list_stages();
    if (arguments.snippets.given())
        return run_snippets(arguments.snippets, arguments.language, arguments.output);
    if (arguments.stage.empty())
        throw UsageError("export: expected --stage ID, --list, --snippets or --pattern");
    CommandFiles files;
    files.add_output("-o", arguments.output);
    files.check_writable();
    const StageInfo& stage = stage_of(arguments.stage);
    std::vector<std::max_align_t> params(stage.params_size / sizeof(std::max_align_t) + 1);
    stage.set_defaults(params.data());
    for (const std::string& text : arguments.parameters) set_parameter(stage, text, params.data());
    const std::string text = export_stage(
        stage.text.id, {arguments.language.empty() ? "glsl" : arguments.language, params.data(),
                        arguments.side, arguments.lights, arguments.uniforms});
    if (arguments.output.empty()) {
        print(text);
        return ExitCode::ok;
    }
    AtomicFile file(arguments.output);
    file.write(text.data(), text.size());
    file.commit();
    say_written(arguments.output);
    return ExitCode::ok;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "export",
        "stages as shader functions, out of their own texts, and exact values out of an engine");
    const auto a = std::make_shared<ExportArguments>();
    verb->add_option("--stage", a->stage, "linear, or trace/linear");
    add_snippet_options(*verb, a->snippets);
    verb->add_option("--language", a->language,
                     "of the function (default: glsl), of the snippets (default: all)")
        ->check(one_word_of(std::vector<std::string>{"glsl", "glsl-es", "hlsl", "wgsl"}));
    verb->add_option("-D", a->parameters, "a parameter of the stage, in place of its default")
        ->type_name("NAME=VALUE");
    verb->add_flag("--uniforms", a->uniforms,
                   "parameters are uniforms where they can be (default: constants)");
    verb->add_option("--side", a->side, "of the maps in texels, which searches of cells know")
        ->check(whole_number(1, 16384))
        ->capture_default_str();
    verb->add_option("--lights", a->lights, "of the scene; the first is directional")
        ->check(whole_number(0, 8))
        ->capture_default_str();
    verb->add_option("-o,--output", a->output, "file (default: standard output)")
        ->type_name("FILE");
    CLI::Option* const list =
        verb->add_flag("--list", a->list, "all stages, and why some are not written");
    // One thing at a time: nothing that is asked for is passed over.
    for (const char* const option :
         {"--stage", "--language", "-D", "--uniforms", "--side", "--lights", "-o"})
        list->excludes(option);
    for (const char* const form : {"--list", "--stage", "-D", "--uniforms", "--side", "--lights"})
        for (const char* const other : {"--snippets", "--pattern"})
            verb->get_option(other)->excludes(form);
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_export(*a); }; });
}

}  // namespace quadrel::cli
