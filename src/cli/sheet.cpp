// quadrel sheet: several renders on one picture to look at.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/common/validators.hpp"
#include "cli/verbs.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

struct SheetArguments {
    std::vector<std::string> inputs;
    std::string output, size, each;
    std::vector<std::string> overrides, plugins;
    ImageSelection selection;  ///< of every EXR
    int columns = 4;
};

/// The values that one key takes in turn, as overrides; one that changes nothing if none is asked
/// for.
struct Variants {
    std::string key;
    std::vector<std::string> values;
};

Variants parse_variants(const std::string& text) {
    if (text.empty()) return {"", {""}};
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(fmt::format("--each: found \"{}\", expected KEY=VALUE,VALUE...", text));
    return {text.substr(0, equals), parse_values("--each", text.substr(equals + 1))};
}

bool is_image(const std::filesystem::path& file) { return file.extension() == ".exr"; }

/// A folder stands for the scenes in it, by name.
std::vector<std::filesystem::path> expand(const std::vector<std::string>& inputs) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path input : inputs) {
        std::error_code error;
        if (!std::filesystem::is_directory(input, error)) {
            files.push_back(input);
            continue;
        }
        const std::size_t first = files.size();
        for (std::filesystem::directory_iterator i(input, error), end; !error && i != end;
             i.increment(error))
            if (i->path().extension() == ".json") files.push_back(i->path());
        if (error) throw InputError(input.string(), "", error.message(), "a readable folder");
        if (files.size() == first)
            throw InputError(input.string(), "", "a folder without scenes",
                             "a folder with .json files");
        std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end());
    }
    return files;
}

/// A picture that is there, or a scene to be rendered.
struct SheetInput {
    std::string label;
    std::filesystem::path file;
    std::optional<Scene> scene;
};

/// Everything that is to be seen; scenes are loaded, so that their inputs are known and their
/// errors come before the first render.
std::vector<SheetInput> open_inputs(const SheetArguments& arguments, const Variants& variants,
                                    CommandFiles& command) {
    std::vector<SheetInput> inputs;
    for (const std::filesystem::path& file : expand(arguments.inputs)) {
        const std::string label = file.stem().string();
        command.add_input(file);
        if (is_image(file)) {
            inputs.push_back({label, file, {}});
            continue;
        }
        for (const std::string& value : variants.values) {
            std::vector<std::string> overrides = with_size(arguments.overrides, arguments.size);
            if (!variants.key.empty()) overrides.push_back(variants.key + "=" + value);
            inputs.push_back({variants.key.empty() ? label : label + " " + value, file,
                              load_scene(file, overrides)});
        }
    }
    return inputs;
}

/// The variants of a scene share what they load; of one scene after the other no more is kept.
void share_textures(std::vector<SheetInput>& inputs) {
    const SheetInput* last = nullptr;
    for (SheetInput& input : inputs) {
        if (!input.scene) continue;
        if (last != nullptr && last->file == input.file)
            input.scene->texture_cache = last->scene->texture_cache;
        last = &input;
    }
}

Picture picture_of(const SheetInput& input, const ImageSelection& selection,
                   const RenderOptions& options) {
    if (!input.scene) return preview(read_exr(input.file, selection).film);
    return preview(render(*input.scene, options));
}

std::vector<SheetEntry> make_entries(const std::vector<SheetInput>& inputs,
                                     const ImageSelection& selection) {
    std::vector<SheetEntry> entries;
    ProgressBar bar;
    RenderOptions options;
    options.channels = {"R", "G", "B", "A"};
    options.baking = [&bar](const std::string& map, double share) { bar.show(share, map); };
    options.not_kept = [&bar](const std::string& reason) { say_not_kept(reason, bar); };
    const Scene* last = nullptr;
    for (const SheetInput& input : inputs) {
        if (last != nullptr && input.scene && last->texture_cache != input.scene->texture_cache)
            last->texture_cache->clear();
        if (input.scene) last = &*input.scene;
        entries.push_back({input.label, picture_of(input, selection, options)});
        bar.show(static_cast<double>(entries.size()) / static_cast<double>(inputs.size()));
    }
    return entries;
}

ExitCode run_sheet(const SheetArguments& arguments) {
    CommandFiles files;
    const Variants variants = parse_variants(arguments.each);
    check_output_kinds({{"-o", ".png", arguments.output}});
    files.add_output("-o", arguments.output);
    files.check_writable();
    load_plugins(arguments.plugins);
    std::vector<SheetInput> inputs = open_inputs(arguments, variants, files);
    share_textures(inputs);
    files.check();
    const auto entries = make_entries(inputs, arguments.selection);
    for (const SheetInput& input : inputs)
        if (input.scene) say_notes(input.scene->notes);
    write_png(arguments.output, contact_sheet(entries, arguments.columns));
    say_written(arguments.output);
    return ExitCode::ok;
}

}  // namespace

void add_sheet(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("sheet", "put EXR images and renders of scenes on one labelled PNG");
    const auto a = std::make_shared<SheetArguments>();
    verb->add_option("inputs", a->inputs, "EXR images, scenes, or folders of scenes, row by row")
        ->required();
    verb->add_option("-o,--output", a->output, "PNG to write")->type_name("OUT.png")->required();
    verb->add_option("--columns", a->columns, "images in a row")
        ->check(whole_number(1, 64))
        ->capture_default_str();
    verb->add_option("-D,--define", a->overrides, "override a value of every scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--each", a->each, "render every scene with each of these values of a key")
        ->type_name("KEY=VALUE,VALUE...");
    add_plugin_option(*verb, a->plugins);
    add_selection_options(*verb, a->selection, "", "every EXR");
    verb->add_option("--size", a->size, "size of every render in pixels")->type_name("WxH");
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_sheet(*a); }; });
}

}  // namespace quadrel::cli
