// quadrel sheet: several renders on one picture to look at.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/console.hpp"
#include "cli/plugins.hpp"
#include "cli/verbs.hpp"
#include "io/atomic_file.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

struct Arguments {
    std::vector<std::string> inputs;
    std::string output, size, each;
    std::vector<std::string> overrides, plugins;
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
    return {text.substr(0, equals), parse_list("--each", text.substr(equals + 1))};
}

bool is_image(const std::filesystem::path& file) { return file.extension() == ".exr"; }

/// A folder stands for the scenes in it, by name.
std::vector<std::filesystem::path> expand(const std::vector<std::string>& inputs) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path input : inputs) {
        if (!std::filesystem::is_directory(input)) {
            files.push_back(input);
            continue;
        }
        const std::size_t first = files.size();
        for (const auto& entry : std::filesystem::directory_iterator(input))
            if (entry.path().extension() == ".json") files.push_back(entry.path());
        std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end());
    }
    return files;
}

void render_variants(const std::filesystem::path& scene_file, const Arguments& arguments,
                     const Variants& variants, std::vector<SheetEntry>& entries,
                     std::vector<std::string>& notes) {
    for (const std::string& value : variants.values) {
        std::vector<std::string> overrides = with_size(arguments.overrides, arguments.size);
        std::string label = scene_file.stem().string();
        if (!variants.key.empty()) {
            overrides.push_back(variants.key + "=" + value);
            label += " " + value;
        }
        RenderOptions options;
        options.channels = {"R", "G", "B", "A"};
        const Scene scene = load_scene(scene_file, overrides);
        notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
        entries.push_back({label, preview(render(scene, options))});
    }
}

ExitCode run_sheet(const Arguments& arguments) {
    const Variants variants = parse_variants(arguments.each);
    load_plugins(arguments.plugins);
    check_writable(arguments.output);
    std::vector<SheetEntry> entries;
    std::vector<std::string> notes;  // printed when the bar is through
    ProgressBar bar;
    const auto files = expand(arguments.inputs);
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (is_image(files[i]))
            entries.push_back({files[i].stem().string(), preview(read_exr(files[i]).film)});
        else
            render_variants(files[i], arguments, variants, entries, notes);
        bar.show(static_cast<double>(i + 1) / static_cast<double>(files.size()));
    }
    bar.clear();
    say_notes(notes);
    write_png(arguments.output, contact_sheet(entries, arguments.columns));
    fmt::print(stderr, "{}\n",
               std::filesystem::absolute(arguments.output).lexically_normal().string());
    return ExitCode::ok;
}

}  // namespace

void add_sheet(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("sheet", "put EXR images and renders of scenes on one labelled PNG");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("inputs", a->inputs, "EXR images, scenes, or folders of scenes, row by row")
        ->required();
    verb->add_option("-o,--output", a->output, "PNG to write")->required();
    verb->add_option("--columns", a->columns, "images in a row")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    verb->add_option("-D,--define", a->overrides, "override a value of every scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb->add_option("--each", a->each, "render every scene with each of these values of a key")
        ->type_name("KEY=VALUE,VALUE...");
    add_plugin_option(*verb, a->plugins);
    verb->add_option("--size", a->size, "size of every render in pixels")->type_name("WxH");
    verb->callback([a, &action] { action = [a] { return run_sheet(*a); }; });
}

}  // namespace quadrel::cli
