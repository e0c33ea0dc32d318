// quadrel-gl: draws exported scenes by OpenGL; and what an implementation of it does where its
// specification leaves a choice, beside what Quadrel does as each kind of hardware.
#include <epoxy/gl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "export/scene/export_scene.hpp"
#include "file/atomic_file.hpp"
#include "file/file_identity.hpp"
#include "file/input_record.hpp"
#include "gl/context/context.hpp"
#include "gl/context/renderer_choice.hpp"
#include "gl/probe/planted.hpp"
#include "gl/probe/report/results.hpp"
#include "gl/scene/draw_scene.hpp"
#include "quadrel/error.hpp"
#include "run_tool.hpp"
#include "text/printable.hpp"

namespace quadrel::gl {
namespace {

struct Arguments {
    bool info = false, probe = false, list = false, json = false, markdown = false, wide = false;
    bool planted = false;
    RendererChoice renderer;
    std::string output, expected, folder;
    std::vector<std::string> only;
    std::vector<int> passes;
};

/// What is to be done, and which options have a say in it.
struct Task {
    std::string name;
    std::vector<std::string_view> options;
};

const std::vector<Task>& tasks() {
    static const std::vector<Task> all{
        {"--list", {"--only", "--json", "--output"}},
        {"--info", {"--json", "--output", "--llvmpipe", "--renderer"}},
        {"--planted", {"--expect", "--llvmpipe", "--renderer"}},
        {"--probe",
         {"--only", "--wide", "--json", "--markdown", "--output", "--llvmpipe", "--renderer",
          "--expect"}},
        {"folder", {"--output", "--pass", "--llvmpipe", "--renderer"}},
    };
    return all;
}

/// No option is passed over in silence.
void check_options(const CLI::App& app) {
    std::vector<const Task*> asked;
    for (const Task& task : tasks())
        if (app.get_option(task.name)->count() > 0) asked.push_back(&task);
    if (asked.empty())
        throw UsageError("what is to be done: a folder, --probe, --planted, --info or --list");
    if (asked.size() > 1)
        throw UsageError(asked[0]->name + " and " + asked[1]->name + ": expected one of them");
    for (const CLI::Option* const option : app.get_options()) {
        const std::string name = option->get_name();
        const auto& known = asked[0]->options;
        if (option->count() > 0 && name != asked[0]->name &&
            std::ranges::find(known, std::string_view(name)) == known.end())
            throw UsageError(name + ": has nothing to say beside " +
                             (asked[0]->name == "folder" ? "a folder" : asked[0]->name));
    }
}

/// To the output file, or to standard output.
void write(const Arguments& arguments, const std::string& text) {
    if (arguments.output.empty()) {
        std::cout << text << std::flush;
        if (!std::cout) throw OutputError("standard output", "could not be written");
        return;
    }
    AtomicFile file(arguments.output);
    file.write(text.data(), text.size());
    file.commit();
}

struct Limit {
    const char* name;
    GLenum what;
};

constexpr Limit limits[] = {{"SUBPIXEL_BITS", GL_SUBPIXEL_BITS},
                            {"MAX_TEXTURE_SIZE", GL_MAX_TEXTURE_SIZE},
                            {"MAX_CUBE_MAP_TEXTURE_SIZE", GL_MAX_CUBE_MAP_TEXTURE_SIZE},
                            {"MAX_RENDERBUFFER_SIZE", GL_MAX_RENDERBUFFER_SIZE},
                            {"MAX_SAMPLES", GL_MAX_SAMPLES},
                            {"MAX_COLOR_TEXTURE_SAMPLES", GL_MAX_COLOR_TEXTURE_SAMPLES},
                            {"MAX_DRAW_BUFFERS", GL_MAX_DRAW_BUFFERS},
                            {"MAX_TEXTURE_IMAGE_UNITS", GL_MAX_TEXTURE_IMAGE_UNITS},
                            {"MAX_TEXTURE_LOD_BIAS", GL_MAX_TEXTURE_LOD_BIAS}};

nlohmann::ordered_json info() {
    nlohmann::ordered_json json{{"renderer", gl_string(GL_RENDERER)},
                                {"vendor", gl_string(GL_VENDOR)},
                                {"version", gl_string(GL_VERSION)},
                                {"glsl", gl_string(GL_SHADING_LANGUAGE_VERSION)}};
    for (const Limit& limit : limits) {
        GLint value = 0;
        glGetIntegerv(limit.what, &value);
        json["limits"][limit.name] = value;
    }
    return json;
}

std::string info_text(const nlohmann::ordered_json& json) {
    std::string text;
    for (const auto& [key, value] : json.items())
        if (value.is_string()) text += key + ": " + value.get<std::string>() + "\n";
    for (const auto& [key, value] : json["limits"].items())
        text += key + ": " + value.dump() + "\n";
    return text;
}

bool is_asked(const Arguments& arguments, const std::string& id) {
    return arguments.only.empty() || std::ranges::count(arguments.only, id) != 0;
}

std::string list_text(const Arguments& arguments) {
    std::string text;
    auto json = nlohmann::ordered_json::array();
    for (const Probe& probe : rules::all_probes()) {
        if (!is_asked(arguments, probe.id)) continue;
        text += probe.id + ": " + probe.asks + "\n    permitted: " + probe.permits + "\n";
        json.push_back({{"id", probe.id}, {"asks", probe.asks}, {"permits", probe.permits}});
    }
    return arguments.json ? json.dump(2) + "\n" : text;
}

/// Whether the expected preset agrees in all that it models. What it does not model, and what the
/// implementation lacks, is said and counts neither way.
bool judge(const Results& results, const std::string& preset) {
    const auto found = disagreements(results, preset);
    std::string unmodelled, missing;
    std::size_t judged = 0;
    for (const ProbeResult& result : results.probes) {
        if (!result.missing.empty())
            missing += " " + result.probe.id;
        else if (!result.probe.not_modelled.empty())
            unmodelled += " " + result.probe.id;
        else
            ++judged;
    }
    if (!unmodelled.empty())
        std::cerr << "quadrel-gl: not judged, since presets do not model it:" << unmodelled << '\n';
    if (!missing.empty())
        std::cerr << "quadrel-gl: not judged, since it could not be asked:" << missing << '\n';
    if (judged == 0)
        throw UsageError("--expect " + preset + ": none of these probes can be judged by it");
    std::cerr << "quadrel-gl: " << judged - found.size() << " of " << judged
              << " probes do as expected\n";
    for (const ProbeResult* result : found)
        for (const PresetResult& one : result->presets)
            if (one.preset == preset)
                std::cerr << "quadrel-gl: " << result->probe.id << ": seen " << result->seen
                          << ", expected " << one.words << " (" << one.differing << " of "
                          << result->answers << " answers differ)\n";
    return found.empty();
}

bool run_probe(const Arguments& arguments) {
    const Results results = run_probes(arguments.only);
    if (arguments.json || std::string_view(arguments.output).ends_with(".json"))
        write(arguments, to_json(results).dump(2) + "\n");
    else
        write(arguments,
              arguments.markdown ? to_markdown(results) : to_text(results, arguments.wide));
    return arguments.expected.empty() || judge(results, arguments.expected);
}

bool run_planted(const std::string& preset) {
    const std::string unnoticed = unnoticed_terms(preset);
    if (unnoticed.empty())
        std::cout << "planted errors: all " << term_count() << " found\n";
    else
        std::cout << "not found: " << unnoticed << '\n';
    return unnoticed.empty();
}

void check_ids(const std::vector<std::string>& only) {
    for (const std::string& id : only) {
        const auto probes = rules::all_probes();
        if (std::none_of(probes.begin(), probes.end(), [&](const Probe& p) { return p.id == id; }))
            throw UsageError("--only: no probe is called " + printable(id) +
                             "; quadrel-gl --list names them");
    }
}

/// What is drawn must not take the place of what was read, nor of other files that the manifest
/// has: among them is what it is to be compared with.
void refuse_files_of(const std::filesystem::path& folder, const InputRecord& inputs,
                     const std::string& output) {
    const auto identity = identity_of(output);
    if (!identity) return;
    std::vector<std::filesystem::path> kept;
    for (const InputFile& input : inputs.files()) kept.push_back(input.name);
    for (const std::string& name : exported_files(folder)) kept.push_back(folder / name);
    for (const std::filesystem::path& file : kept)
        if (identity_of(file) == identity)
            throw UsageError("-o " + printable(output) + " is " + printable(file.string()) +
                             " of the exported folder, expected another file");
}

/// Draws an exported scene into an EXR.
void draw_folder(const Arguments& arguments) {
    if (arguments.output.empty()) throw UsageError("expected -o OUT.exr for what is drawn");
    if (!std::string_view(arguments.output).ends_with(".exr"))
        throw UsageError("-o: found " + printable(arguments.output) + ", expected a name in .exr");
    const InputRecord inputs;
    const ExportedScene scene = read_exported_scene(arguments.folder);
    refuse_files_of(arguments.folder, inputs, arguments.output);
    write_exr(arguments.output, draw_scene(scene, arguments.passes), drawing_attributes(scene));
}

bool run(const Arguments& arguments) {
    check_ids(arguments.only);
    if (arguments.list) {
        write(arguments, list_text(arguments));
        return true;
    }
    const Context context = chosen_context(arguments.renderer);
    if (arguments.info) {
        const nlohmann::ordered_json json = info();
        write(arguments, arguments.json ? json.dump(2) + "\n" : info_text(json));
        return true;
    }
    if (arguments.planted) return run_planted(arguments.expected);
    if (arguments.probe) return run_probe(arguments);
    draw_folder(arguments);
    return true;
}

void add_options(CLI::App& app, Arguments& a) {
    app.add_option("folder", a.folder, "a scene that `quadrel export` has written, to be drawn");
    app.add_option("--pass", a.passes, "of a folder, this pass alone; repeatable")
        ->type_name("N")
        ->allow_extra_args(false);
    app.add_flag("--info", a.info, "renderer, version, limits");
    app.add_flag("--probe", a.probe, "what it does where it may choose, beside Quadrel's presets");
    app.add_flag("--list", a.list, "the probes: what is asked, and what is permitted");
    app.add_option("--only", a.only, "these probes alone")->type_name("ID");
    app.add_flag("--wide", a.wide, "with what each preset does where it is not the same");
    app.add_flag("--json", a.json, "as JSON, with all that is known of each probe");
    app.add_flag("--markdown", a.markdown, "the table in Markdown");
    app.add_option("-o,--output", a.output, "into a file; .json: as JSON; of a folder, the EXR")
        ->type_name("FILE");
    add_renderer_options(app, a.renderer);
    app.add_option("--expect", a.expected,
                   "fail where this preset does not agree in what it models")
        ->check(CLI::IsMember(preset_names()));
    app.add_flag("--planted", a.planted,
                 "with --expect: whether a change to each term of the preset is noticed")
        ->needs("--expect");
    app.footer(
        "Exit codes: 0 done; 1 the expected preset does not agree; 2 bad command line; 3 there is "
        "no "
        "OpenGL to ask; 5 output could not be written.");
}

}  // namespace
}  // namespace quadrel::gl

int main(int argc, char** argv) {
    using namespace quadrel::gl;
    CLI::App app(
        "Draws exported scenes by OpenGL, and asks an implementation what it does where it may "
        "choose",
        "quadrel-gl");
    Arguments arguments;
    add_options(app, arguments);
    return quadrel::run_tool(app, argc, argv, [&] {
        check_options(app);
        return run(arguments);
    });
}
