// quadrel-gl: what an implementation of OpenGL does where its specification leaves a choice, beside
// what Quadrel does as each kind of hardware.
#include <epoxy/gl.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "file/atomic_file.hpp"
#include "gl/context/context.hpp"
#include "gl/probe/planted.hpp"
#include "gl/probe/report/results.hpp"
#include "quadrel/error.hpp"
#include "text/printable.hpp"

namespace quadrel::gl {
namespace {

struct Arguments {
    bool info = false, probe = false, list = false, json = false, markdown = false, wide = false;
    bool planted = false, llvmpipe = false;
    std::string output, expected, renderer;
    std::vector<std::string> only;
};

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

std::string list_text() {
    std::string text;
    for (const Probe& probe : all_probes())
        text += probe.id + ": " + probe.asks + "\n    permitted: " + probe.permits + "\n";
    return text;
}

/// Whether the expected preset agrees in all that it models.
bool judge(const Results& results, const std::string& preset) {
    const auto found = disagreements(results, preset);
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
        const auto probes = all_probes();
        if (std::none_of(probes.begin(), probes.end(), [&](const Probe& p) { return p.id == id; }))
            throw UsageError("--only: no probe is called " + printable(id) +
                             "; quadrel-gl --list names them");
    }
}

bool run(const Arguments& arguments) {
    check_ids(arguments.only);
    if (arguments.list) {
        write(arguments, list_text());
        return true;
    }
    if (!arguments.info && !arguments.probe && !arguments.planted)
        throw UsageError("what is to be done: --info, --probe or --list");
    const Context context = arguments.llvmpipe ? Context::llvmpipe(0) : Context::at_hand();
    if (gl_string(GL_RENDERER).find(arguments.renderer) == std::string::npos)
        throw std::runtime_error("skipped: the renderer is " + printable(gl_string(GL_RENDERER)));
    if (arguments.info) {
        const nlohmann::ordered_json json = info();
        write(arguments, arguments.json ? json.dump(2) + "\n" : info_text(json));
        return true;
    }
    if (arguments.planted) return run_planted(arguments.expected);
    return run_probe(arguments);
}

void add_options(CLI::App& app, Arguments& a) {
    app.add_flag("--info", a.info, "renderer, version, limits");
    app.add_flag("--probe", a.probe, "what it does where it may choose, beside Quadrel's presets");
    app.add_flag("--list", a.list, "the probes: what is asked, and what is permitted");
    app.add_option("--only", a.only, "these probes alone")->type_name("ID");
    app.add_flag("--wide", a.wide, "with what each preset does where it is not the same");
    app.add_flag("--json", a.json, "as JSON, with all that is known of each probe");
    app.add_flag("--markdown", a.markdown, "the table in Markdown");
    app.add_option("-o,--output", a.output, "into a file; .json: as JSON")->type_name("FILE");
    app.add_flag("--llvmpipe", a.llvmpipe, "Mesa's llvmpipe, whatever else there is");
    app.add_option("--renderer", a.renderer,
                   "nothing (exit code 3) where its name has not this in it")
        ->type_name("TEXT");
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

int fail(const std::exception& error, ExitCode code) {
    std::cerr << "quadrel-gl: " << error.what() << '\n';
    return static_cast<int>(code);
}

int guarded_run(const Arguments& arguments) {
    try {
        return static_cast<int>(run(arguments) ? ExitCode::ok : ExitCode::difference);
    } catch (const UsageError& error) {
        return fail(error, ExitCode::usage);
    } catch (const OutputError& error) {
        return fail(error, ExitCode::output);
    } catch (const std::runtime_error& error) {
        return fail(error, ExitCode::input);
    } catch (const std::exception& error) {
        return fail(error, ExitCode::internal);
    }
}

}  // namespace
}  // namespace quadrel::gl

int main(int argc, char** argv) {
    using namespace quadrel::gl;
    CLI::App app("What an OpenGL implementation does where it may choose", "quadrel-gl");
    Arguments arguments;
    add_options(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(quadrel::ExitCode::usage);
    }
    return guarded_run(arguments);
}
