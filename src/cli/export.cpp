// quadrel export: what other programs take over: scenes as folders, stages as functions of shaders,
// snippets.
#include "export/export.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>

#include "bake/wrap_names.hpp"
#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/filtered_rows.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/validators.hpp"
#include "cli/snippets.hpp"
#include "cli/verbs.hpp"
#include "cli/view.hpp"
#include "export/scene/export_scene.hpp"
#include "export/scene/judge_page.hpp"
#include "export/scene/output_folder.hpp"
#include "file/atomic_file.hpp"
#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "render/plan/shell_check.hpp"

namespace quadrel::cli {
namespace {

struct ExportArguments {
    SnippetArguments snippets;
    std::string scene, language, output, channels, size, page, limits = "gl";
    std::vector<std::string> words, stages, assignments, wrap;
    ExportOptions plain;
    int light = 0, every = 1;
    bool list = false;
};

/// The first word stands where a scene's name does.
ExitCode list_stages(const ExportArguments& arguments) {
    std::vector<std::string> words = arguments.words;
    if (!arguments.scene.empty()) words.push_back(arguments.scene);
    ListRows rows;
    for (const ExportRow& row : export_rows()) {
        const StageInfo& stage = *find_stage(row.id);
        const StageText& of = stage.text;
        const bool has_vertex_part = stage.reads_vertices && !is_of_shells(of.id);
        const std::string yes = has_vertex_part ? "yes, in part in the vertex shader" : "yes";
        const std::string text = fmt::format("{:<34} {}\n", row.room + "/" + row.id,
                                             row.refusal.empty() ? yes : "no: " + row.refusal);
        rows.push_back({fmt::format("{} {} {}", text, of.summary, of.source), text, {}});
    }
    for (const ListRow& row : filtered_rows(std::move(rows), words)) print(row.text);
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

/// A stage with its parameters.
struct ChosenStage {
    const StageInfo* stage;
    std::vector<std::max_align_t> params;

    explicit ChosenStage(const StageInfo& of)
        : stage(&of), params(of.params_size / sizeof(std::max_align_t) + 1) {
        of.set_defaults(params.data());
    }

    /// False where it has no parameter of that name.
    bool set(const std::string& name, const ParameterValue& value) {
        const ParameterText* const parameter = find_parameter(stage->text.id, name);
        if (parameter == nullptr) return false;
        const std::optional<double> number = number_of(*parameter, value);
        if (!number)
            throw UsageError(fmt::format("-D {}: found {}, expected {}", name, text_of(value),
                                         expected_of(*parameter, value)));
        parameter->set(params.data(), *number);
        return true;
    }
};

/// In all stages that have the parameter; one has to.
void set_parameter(std::vector<ChosenStage>& stages, const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    bool is_set = false;
    if (equals != std::string::npos)
        for (ChosenStage& stage : stages)
            is_set |= stage.set(name, value_of(text.substr(equals + 1)));
    if (is_set) return;
    std::vector<std::string> known;
    for (const ChosenStage& stage : stages)
        for (const ParameterText& of : stage.stage->parameters) known.emplace_back(of.name);
    if (std::find(known.begin(), known.end(), text) != known.end())
        throw UsageError(fmt::format("-D: found \"{}\", expected {}=VALUE", text, text));
    throw UsageError(
        fmt::format("-D: found \"{}\", expected {}=VALUE", text,
                    known.empty() ? "no parameter of this stage, NAME" : one_of(name, known)));
}

/// What is said of the scene of stages.
ExportOptions plain_options(const ExportArguments& arguments) {
    ExportOptions options = arguments.plain;
    if (!arguments.language.empty()) options.language = arguments.language;
    if (arguments.wrap.size() > 2)
        throw UsageError("--wrap: expected one mode, or two: for u and for v");
    if (!arguments.wrap.empty()) {
        options.wrap_u = wrap_modes().at(arguments.wrap.front());
        options.wrap_v = wrap_modes().at(arguments.wrap.back());
    }
    if (!(options.seat >= 0 && options.seat <= 1))  // NaN passes CLI::Range
        throw UsageError("--seat: found no number, expected 0 to 1");
    if (arguments.light != 0 && arguments.light >= options.lights)
        throw UsageError(fmt::format("--light: found {}, expected one of {} lights",
                                     arguments.light, options.lights));
    return options;
}

ExitCode write_stages(const ExportArguments& arguments) {
    const ExportOptions options = plain_options(arguments);
    CommandFiles files;
    files.add_output("-o", arguments.output);
    files.check_writable();
    std::vector<ChosenStage> stages;
    for (const std::string& name : arguments.stages) {
        const StageInfo& stage = stage_of(name);
        for (const ChosenStage& other : stages)
            if (other.stage == &stage)
                throw UsageError(fmt::format("--stage: found \"{}\" twice", name));
        stages.emplace_back(stage);
    }
    for (const std::string& text : arguments.assignments) set_parameter(stages, text);
    std::vector<StageUse> uses;
    for (const ChosenStage& stage : stages)
        uses.push_back({stage.stage->text.id, stage.params.data(), arguments.light});
    const std::string text = export_stages(uses, options);
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

/// No input may go with a folder that is replaced.
void check_inputs(const InputRecord& inputs, const std::filesystem::path& folder) {
    const std::filesystem::path at = folder_at(folder);
    for (const InputFile& input : inputs.files()) {
        std::error_code error;
        const auto file = std::filesystem::weakly_canonical(input.name, error);
        const auto [end, rest] = std::mismatch(at.begin(), at.end(), file.begin(), file.end());
        if (!error && end == at.end())
            throw UsageError(fmt::format("-o {} has the input {}, expected another folder",
                                         folder.string(), input.name.string()));
    }
}

Scene scene_of(const ExportArguments& arguments) {
    Scene scene = load_scene(arguments.scene, with_size(arguments.assignments, arguments.size));
    say_notes(scene.notes);
    return scene;
}

/// `bar` has to stay as long as they do.
SceneExport scene_options(const ExportArguments& arguments, ProgressBar& bar) {
    SceneExport options;
    if (!arguments.language.empty()) options.language = arguments.language;
    if (!arguments.channels.empty())
        options.channels = parse_list("--channels", arguments.channels);
    options.progress = [&bar](double share) { bar.show(share); };
    options.baking = [&bar](const std::string& map, double share) { bar.show(share, map); };
    options.not_kept = [&bar](const std::string& reason) { say_not_kept(reason, bar); };
    return options;
}

ExitCode write_judge_page(const ExportArguments& arguments) {
    CommandFiles files;
    check_output_kinds({{"--page", ".html", arguments.page}});
    files.add_output("--page", arguments.page);
    files.check_writable();
    const Scene scene = scene_of(arguments);
    files.check();
    ProgressBar bar;
    const std::string page =
        judge_page(scene, {scene_options(arguments, bar),
                           arguments.limits == "none" ? "" : arguments.limits, arguments.every});
    bar.clear();
    write_page(arguments.page, page, "--channels and --size choose less");
    return ExitCode::ok;
}

ExitCode write_scene(const ExportArguments& arguments) {
    if (arguments.output.empty())
        throw UsageError("export: expected -o DIR or --page OUT.html for a scene");
    if (arguments.output == "-")
        throw UsageError("-o: found -, expected the name of a folder for a scene");
    const InputRecord inputs;
    check_export_folder(arguments.output);
    const Scene scene = scene_of(arguments);
    ProgressBar bar;
    const SceneExport options = scene_options(arguments, bar);
    check_inputs(inputs, arguments.output);
    export_scene(scene, options, arguments.output);
    bar.clear();
    say_written(std::filesystem::path(arguments.output) / "manifest.json");
    return ExitCode::ok;
}

ExitCode run_export(const ExportArguments& arguments) {
    if (arguments.list) return list_stages(arguments);
    if (!arguments.words.empty())
        throw UsageError(
            fmt::format("export: found \"{}\" after \"{}\", expected one SCENE, or --list",
                        arguments.words.front(), arguments.scene));
    if (arguments.snippets.given())
        return run_snippets(arguments.snippets, arguments.language, arguments.output);
    if (!arguments.scene.empty())
        return arguments.page.empty() ? write_scene(arguments) : write_judge_page(arguments);
    if (!arguments.stages.empty()) return write_stages(arguments);
    if (!arguments.page.empty()) throw UsageError("--page: expected a SCENE");
    throw UsageError("export: expected a SCENE, --stage ID, --list, --snippets or --pattern");
}

void add_stage_options(CLI::App& verb, ExportArguments& a) {
    verb.add_option("--stage", a.stages, "linear, or trace/linear; repeatable: one file with all")
        ->allow_extra_args(false);
    verb.add_flag("--uniforms", a.plain.uniforms,
                  "parameters are uniforms where they can be (default: constants)");
    verb.add_option("--side", a.plain.side, "of the maps in texels, which searches of cells know")
        ->check(whole_number(1, 16384))
        ->capture_default_str();
    verb.add_option("--wrap", a.wrap,
                    "how the maps go on, which searches of cells know (repeat); twice: along u and "
                    "along v")
        ->allow_extra_args(false)
        ->check(one_word_of(wrap_modes()));
    verb.add_option("--seat", a.plain.seat, "height at which the polygon lies, which searches know")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    verb.add_option("--lights", a.plain.lights, "of the scene; the first is directional")
        ->check(whole_number(0, 8))
        ->capture_default_str();
    verb.add_option("--light", a.light, "that a shadow is of")
        ->check(whole_number(0, 7))
        ->capture_default_str();
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "export",
        "a scene as shaders with all that they draw; stages as functions; exact values out of an "
        "engine");
    const auto a = std::make_shared<ExportArguments>();
    verb->add_option("scene", a->scene, "scene file, or the name of an installed scene");
    verb->add_flag(
        "--list", a->list,
        "all stages, or of them what has all words that follow, and why some are not written");
    verb->add_option("words", a->words, "of --list: only stages that have all of these words");
    add_stage_options(*verb, *a);
    add_snippet_options(*verb, a->snippets);
    verb->add_option("--language", a->language,
                     "of shaders (default: glsl), of the snippets (default: all)")
        ->check(one_word_of(std::vector<std::string>{"glsl", "glsl-es", "hlsl", "wgsl"}));
    verb->add_option(
            "-D,--define", a->assignments,
            "a value of the scene, as for render, or a parameter of the stages; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--size", a->size, "of the scene's image in pixels")->type_name("WxH");
    verb->add_option("--channels", a->channels,
                     "comma-separated channels that a scene's shaders write (default: all that "
                     "they can)");
    verb->add_option("-o,--output", a->output,
                     "folder of a scene, replaced where it is an export; else a file (default: "
                     "standard output)")
        ->type_name("DIR|FILE");
    verb->add_option(
            "--page", a->page,
            "one page that draws the scene on the GPU of whoever opens it, and judges what "
            "that gives")
        ->type_name("OUT.html");
    verb->add_option("--limits", a->limits,
                     "of a page: judge by what this interface permits, as for render; none: show "
                     "differences alone")
        ->type_name("INTERFACE")
        ->needs("--page")
        ->capture_default_str();
    verb->add_option("--every", a->every,
                     "of a page: judge every so-manyth row of quads alone, since ranges of a march "
                     "with shadows take some 50 ms per pixel")
        ->needs("--page")
        ->check(whole_number(1, 1024))
        ->capture_default_str();
    // One thing at a time: nothing that is asked for is passed over.
    const std::vector<const char*> of_stages = {"--uniforms", "--side",   "--wrap",
                                                "--seat",     "--lights", "--light"};
    const auto exclude = [&](const char* form, std::initializer_list<const char*> others) {
        for (const char* const other : others) verb->get_option(form)->excludes(other);
    };
    exclude("--list", {"--stage", "--language", "-D", "-o", "--size", "--channels", "--page"});
    for (const char* const form : {"--snippets", "--pattern"})
        exclude(form, {"scene", "--list", "--stage", "-D", "--size", "--channels", "--page"});
    exclude("scene", {"--stage"});
    exclude("--stage", {"--size", "--channels", "--page"});
    exclude("--page", {"-o", "--language"});
    for (const char* const option : of_stages)
        exclude(option, {"scene", "--list", "--snippets", "--pattern"});
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_export(*a); }; });
}

}  // namespace quadrel::cli
