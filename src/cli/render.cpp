// quadrel render: a scene to an EXR of named channels.
#include "quadrel/render.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/compression_option.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/injections.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/validators.hpp"
#include "cli/render_summary.hpp"
#include "cli/verbs.hpp"
#include "cli/watch/watch.hpp"
#include "file/named_descriptor.hpp"
#include "file/output_group.hpp"
#include "film/preview_sink.hpp"
#include "io/exr/encode.hpp"
#include "io/exr/file_sink.hpp"
#include "io/parts/image_part.hpp"
#include "io/tev/sink.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/bands/draw_bands.hpp"

namespace quadrel::cli {
namespace {

struct RenderArguments {
    std::string scene, output, preview, stats, channels, size, window, task, tev;
    std::vector<std::string> overrides, plugins, injected;
    bool explain = false, no_skip = false, watch = false;
    std::optional<int> integral_samples;
    std::optional<double> integral_error;
    bool streams() const { return output == "-"; }  ///< the EXR goes to standard output
    RenderOptions options;
    ExrCompression compression = ExrCompression::zip;
};

/// The output's name unless it is given: the scene's, in the current directory.
std::filesystem::path output_name(const RenderArguments& arguments) {
    if (!arguments.output.empty()) return arguments.output;
    const std::string name = std::filesystem::path(arguments.scene).stem().string();
    if (arguments.task.empty()) return name + ".exr";
    const Task task = parse_task(arguments.task);
    return fmt::format("{}.{}-of-{}.exr", name, task.number, task.of);
}

void tell_hint(const std::optional<std::string>& hint) {
    if (hint) tell("quadrel: " + *hint);
}

/// Either option makes pixels integrals.
std::optional<IntegralOptions> integral_options(const RenderArguments& arguments) {
    if (!arguments.integral_samples && !arguments.integral_error) return std::nullopt;
    IntegralOptions integral;
    if (arguments.integral_samples) integral.samples = *arguments.integral_samples;
    if (!arguments.integral_error) return integral;
    if (!(*arguments.integral_error > 0))
        throw UsageError(fmt::format("--integrate-error: found {}, expected a number above 0",
                                     *arguments.integral_error));
    integral.error = *arguments.integral_error;
    return integral;
}

RenderOptions parse_options(const RenderArguments& arguments) {
    RenderOptions options = arguments.options;
    options.integral = integral_options(arguments);
    if (!arguments.channels.empty()) {
        const std::vector<std::string> requests = parse_list("--channels", arguments.channels);
        options.channels = expand_channels(requests);
        tell_hint(bitangent_hint(requests));
    }
    tell_hint(threads_hint(options.threads));
    if (!arguments.window.empty()) options.window = parse_window("--window", arguments.window);
    options.skip = !arguments.no_skip;
    return options;
}

/// Whether it can be written anew again and again: a file, or what takes everything.
bool is_written_anew(const std::filesystem::path& output) {
    if (named_descriptor(output)) return false;  // of a file it would have the first image alone
    std::error_code none;
    const auto kind = std::filesystem::status(output, none).type();
    return output.empty() || kind == std::filesystem::file_type::not_found ||
           kind == std::filesystem::file_type::regular ||
           std::filesystem::equivalent(output, "/dev/null", none);
}

void check_watched(const RenderArguments& arguments) {
    if (arguments.explain || arguments.streams() || !arguments.stats.empty() ||
        !arguments.task.empty() || !arguments.injected.empty())
        throw UsageError(
            "--watch: expected no --explain, --stats, --task, --inject or -o - beside it");
    for (const std::string& output : {output_name(arguments).string(), arguments.preview})
        if (!is_written_anew(output))
            throw UsageError("--watch: found the output " + output +
                             ", expected a file, which is written anew after each change");
}

/// What the names of the outputs say.
void check_kinds(const RenderArguments& arguments) {
    check_output_kinds({{"-o", ".exr", arguments.output},
                        {"--preview", ".png", arguments.preview},
                        {"--stats", ".json", arguments.stats}});
    if (arguments.preview == "-" || arguments.stats == "-")
        throw UsageError("--preview and --stats: found -, expected a file; -o - is possible");
    if (arguments.streams() && !arguments.explain && isatty(STDOUT_FILENO) != 0)
        throw UsageError("-o -: expected standard output to be a file or a pipe, not a terminal");
    if (arguments.watch) check_watched(arguments);
}

void add_outputs(CommandFiles& files, const RenderArguments& arguments) {
    if (arguments.explain) return;
    if (arguments.streams())
        files.add_standard_output("-o -");
    else
        files.add_output("-o", output_name(arguments));
    files.add_output("--preview", arguments.preview);
    files.add_output("--stats", arguments.stats);
}

void check_window(const RenderOptions& options, const Scene& scene) {
    if (!options.window || contains({0, 0, scene.width, scene.height}, *options.window)) return;
    throw UsageError(
        fmt::format("--window: found a window that ends at {},{}, expected one in "
                    "the {}x{} image",
                    options.window->x1, options.window->y1, scene.width, scene.height));
}

/// A render that is one part of an image: its rows, and what tells it from others.
struct RenderedPart {
    ImagePart part;
    std::string hash;
};

/// Narrows the window to the part's rows. Nothing where the image is drawn whole.
std::optional<RenderedPart> take_part(const RenderArguments& arguments, const Scene& scene,
                                      RenderOptions& options) {
    if (arguments.task.empty()) return std::nullopt;
    const Task task = parse_task(arguments.task);
    const Window frame{0, 0, scene.width, scene.height};
    RenderedPart rendered{{task.number, task.of, options.window.value_or(frame)}, ""};
    options.window = part_window(rendered.part);
    const auto named = render_attributes(scene, options);
    rendered.hash = part_hash(rendered.part, frame, {named.begin(), named.end()},
                              expand_channels(options.channels), arguments.compression);
    return rendered;
}

/// Whether the part is there from before; other outputs are drawn anew.
bool is_finished(const RenderArguments& arguments, const std::optional<RenderedPart>& part) {
    if (!part || arguments.explain || arguments.streams()) return false;
    if (!arguments.preview.empty() || !arguments.stats.empty()) return false;
    if (!is_finished_part(output_name(arguments), part->hash)) return false;
    tell(fmt::format("quadrel: {} is finished: part {}/{}, hash {}",
                     output_name(arguments).string(), part->part.number, part->part.of,
                     part->hash.substr(0, 16)));
    return true;
}

void render_with_bar(const Scene& scene, RenderOptions& options, const BandSinkMaker& make) {
    ProgressBar bar;
    options.progress = [&bar](double share) { bar.show(share); };
    options.baking = [&bar](const std::string& map, double share) { bar.show(share, map); };
    options.not_kept = [&bar](const std::string& reason) { say_not_kept(reason, bar); };
    render_bands(scene, options, make);
    options.progress = nullptr;
    options.baking = nullptr;
    options.not_kept = nullptr;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    AtomicFile out(file);
    out.write(text.data(), text.size());
    out.commit();
}

/// What viewers call the image.
std::string image_name(const RenderArguments& arguments) {
    return arguments.streams() ? arguments.scene : output_name(arguments).string();
}

/// The EXR: a file, or bytes that wait in `streamed` for standard output.
std::unique_ptr<BandSink> exr_sink(const RenderArguments& arguments, const Film& layout,
                                   const Attributes& attributes, std::string& streamed) {
    if (!arguments.streams())
        return exr_file_sink(output_name(arguments), layout, attributes, arguments.compression);
    return exr_band_sink(layout, attributes, arguments.compression, append_to(streamed));
}

void render_outputs(const RenderArguments& arguments, const Scene& scene, RenderOptions& options,
                    const std::optional<RenderedPart>& part, TevConnection* tev) {
    const auto named = render_attributes(scene, options);
    Attributes attributes(named.begin(), named.end());
    if (part) name_part(part->part, part->hash, attributes);
    std::string streamed;
    OutputGroup outputs;
    render_with_bar(scene, options, [&](const Film& layout) {
        std::vector<std::unique_ptr<BandSink>> sinks;
        sinks.push_back(exr_sink(arguments, layout, attributes, streamed));
        if (!arguments.preview.empty()) sinks.push_back(png_file_sink(arguments.preview, layout));
        if (tev != nullptr) sinks.push_back(tev_sink(*tev, image_name(arguments), layout));
        return join_sinks(std::move(sinks));
    });
    if (!arguments.stats.empty()) write_text(arguments.stats, to_json(*options.stats));
    if (arguments.streams()) {
        print_bytes(streamed);
        flush_output();
    }
    outputs.commit();
    if (!arguments.streams()) say_written(output_name(arguments));
    if (!arguments.preview.empty()) say_written(arguments.preview);
}

/// The scene as it is now, `files` being what was read for it.
Scene load_watched(const RenderArguments& arguments, const RenderOptions& options,
                   std::vector<std::filesystem::path>& files) {
    CommandFiles now;
    add_outputs(now, arguments);
    try {
        Scene scene = load_scene(arguments.scene, with_size(arguments.overrides, arguments.size));
        files = now.inputs();
        now.check();
        say_notes(scene.notes);
        check_window(options, scene);
        return scene;
    } catch (const InputError&) {
        files = now.inputs();
        throw;
    }
}

/// Does not return: draws until the process is ended.
ExitCode watch_scene(const RenderArguments& arguments, const RenderOptions& options,
                     TevConnection* tev) {
    WatchedRender render;
    render.load = [&](std::vector<std::filesystem::path>& files) {
        return load_watched(arguments, options, files);
    };
    render.options = options;
    render.output = output_name(arguments);
    render.preview = arguments.preview;
    render.compression = arguments.compression;
    render.tev = tev;
    watch(render);
}

void say_lost(const TevConnection* tev) {
    if (tev != nullptr && !tev->lost().empty())
        say("quadrel: warning: tev was sent nothing more: " + tev->lost());
}

/// A part of an image may well be empty.
void say_summary(const RenderSummary& summary, bool is_part) {
    if (isatty(STDERR_FILENO) != 0) tell(summary_line(summary));
    if (is_part) return;
    if (const auto warning = nothing_in_view(summary)) say("quadrel: warning: " + *warning);
}

ExitCode run_render(const RenderArguments& arguments) {
    CommandFiles files;
    add_outputs(files, arguments);
    load_plugins(arguments.plugins);
    RenderOptions options = parse_options(arguments);
    files.check_writable();
    const Scene scene = load_scene(arguments.scene, with_size(arguments.overrides, arguments.size));
    files.check();
    check_kinds(arguments);
    say_notes(scene.notes);
    check_window(options, scene);
    options.injected = read_injections(arguments.injected);
    files.check();
    const std::optional<RenderedPart> part = take_part(arguments, scene, options);
    if (arguments.explain) {
        print(explain(scene, options));
        return ExitCode::ok;
    }
    if (is_finished(arguments, part)) return ExitCode::ok;
    std::optional<TevConnection> tev;
    if (!arguments.tev.empty()) tev.emplace(arguments.tev);
    if (arguments.watch) return watch_scene(arguments, options, tev ? &*tev : nullptr);
    RenderStats stats;
    if (!arguments.stats.empty()) options.stats = &stats;
    RenderSummary summary;
    options.summary = &summary;
    render_outputs(arguments, scene, options, part, tev ? &*tev : nullptr);
    say_lost(tev ? &*tev : nullptr);
    say_summary(summary, part.has_value());
    return ExitCode::ok;
}

void add_values(CLI::App& verb, RenderArguments& a) {
    verb.add_option("scene", a.scene, "scene file, or the name of an installed scene")->required();
    verb.add_option("-o,--output", a.output,
                    "EXR to write (default: the scene's name in the current directory); "
                    "-: standard output")
        ->type_name("OUT.exr");
    verb.add_option("-D,--define", a.overrides,
                    "override a value of the scene, as material.relief.steps=256; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb.add_option("--channels", a.channels,
                    "comma-separated channels or groups (default R,G,B,A,Z; see list channels)");
    verb.add_option("--integrate", a.integral_samples,
                    "each pixel the mean of so many samples of its area, without derivatives and "
                    "mip levels: a multiple of 16")
        ->type_name("N");
    verb.add_option("--integrate-error", a.integral_error,
                    "no more samples where the mean's standard error is at most this; --integrate "
                    "is the most then (4096)")
        ->type_name("ERROR");
    verb.add_option("--size", a.size, "image size in pixels")->type_name("WxH");
    verb.add_option("--window", a.window,
                    "render this part only: half-open, pixels from the top-left")
        ->type_name("X0,Y0,X1,Y1");
    verb.add_option("--task", a.task,
                    "only the I-th of N parts, rows of tiles, for join to put together; one that "
                    "is there already is not drawn again")
        ->type_name("I/N");
    verb.add_flag("--watch", a.watch,
                  "draw again whenever the scene or one of its files changes, and only what the "
                  "change touches, until Ctrl-C");
    verb.add_flag(std::string("--tev{") + tev_address + "}", a.tev,
                  "also send tiles to the viewer tev as they are drawn; --tev=HOST:PORT where it "
                  "is not at " +
                      std::string(tev_address));
    verb.add_flag("--explain", a.explain, "print the plan and render nothing");
    add_compression_option(verb, a.compression);
    verb.add_option("--stats", a.stats, "also write what the render did and took, as JSON")
        ->type_name("OUT.json");
    verb.add_flag("--touched", a.options.touched,
                  "with --stats: also which texels look-ups touched and how many steps searches "
                  "made; takes several times as long as the render")
        ->needs("--stats");
    verb.add_option("--preview", a.preview, "also write an 8-bit sRGB PNG to look at")
        ->type_name("OUT.png");
}

void add_execution(CLI::App& verb, RenderOptions& options) {
    verb.add_option("--number", options.number,
                    "number type of the shading; double runs on scalar alone")
        ->check(one_word_of(std::vector<std::string>{"float", "double"}))
        ->capture_default_str();
    verb.add_option(
            "--limits", options.limits,
            "also render what an implementation of this interface may give: gpu.lo.X, "
            "gpu.hi.X, gpu.paths.X and gpu.gap.*.X for each channel X; vulkan, d3d, gl or webgpu, "
            "or rounding: what float32's rounding alone may change")
        ->type_name("INTERFACE");
    verb.add_option("--isa", options.isa, "instruction set; the bits do not depend on it")
        ->check(one_word_of(
            std::vector<std::string>{"auto", "scalar", "sse4", "avx2", "avx512", "neon"}))
        ->capture_default_str();
    verb.add_option("-t,--threads", options.threads,
                    "threads; 0: as many as there are CPUs, more are obeyed")
        ->check(whole_number(0, 1024))
        ->capture_default_str();
    verb.add_option("--tile", options.tile, "side of a tile in pixels, even")
        ->check(whole_number(2, 1024))
        ->capture_default_str();
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("render", "render a scene to an EXR of named channels");
    const auto arguments = std::make_shared<RenderArguments>();
    add_values(*verb, *arguments);
    add_plugin_option(*verb, arguments->plugins);
    add_inject_option(*verb, arguments->injected);
    verb->add_flag("--no-skip", arguments->no_skip,
                   "compute and load what no channel asks for, too; the bits are the same");
    add_quiet_option(*verb);
    add_execution(*verb, arguments->options);
    verb->callback(
        [arguments, &action] { action = [arguments] { return run_render(*arguments); }; });
}

}  // namespace quadrel::cli
