// quadrel bake: a map derived from a height field, into a file and into the cache.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>

#include "bake/wrap_names.hpp"
#include "cli/bake_layers.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/compression_option.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/common/validators.hpp"
#include "cli/verbs.hpp"
#include "file/output_group.hpp"
#include "quadrel/bake/baked_file.hpp"
#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/bake/packed_map.hpp"
#include "quadrel/error.hpp"
#include "texture/swizzle.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::cli {
namespace {

struct BakeArguments {
    std::string image, kind, output, channel = "r", wrap_u = "repeat", wrap_v = "repeat", wrap;
    std::string format, packed, packing = "dummer", rounding = "conservative";
    std::vector<std::string> parameters;
    ImageSelection selection;
    ExrCompression compression = ExrCompression::zip;
    float border = 0;
    int threads = 0;
    bool flip_v = false, no_cache = false;
    LayerArguments layers;
};

std::shared_ptr<const Texture> load_heights(const BakeArguments& arguments, BakeKind kind) {
    TextureOptions options;
    if (!bakes_layers(kind)) options.swizzle = arguments.channel;
    for (const auto& [name, format] : named_formats)
        if (name == arguments.format) options.format = format;
    options.flip_v = arguments.flip_v;
    options.mip_rule = MipRule::none;
    return make_texture(load_image(arguments.image, NotFinite::refuse, "", arguments.selection),
                        options);
}

SamplerState make_sampler(const BakeArguments& arguments) {
    SamplerState sampler;
    const bool both = !arguments.wrap.empty();
    sampler.wrap_u = wrap_modes().at(both ? arguments.wrap : arguments.wrap_u);
    sampler.wrap_v = wrap_modes().at(both ? arguments.wrap : arguments.wrap_v);
    std::fill(std::begin(sampler.border), std::end(sampler.border), arguments.border);
    return sampler;
}

/// "name=value".
std::pair<std::string, double> parse_parameter(const std::string& text) {
    const std::size_t equals = text.find('=');
    double value = 0;
    if (equals != std::string::npos) {
        const char* const end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data() + equals + 1, end, value);
        if (parsed.ec == std::errc() && parsed.ptr == end) return {text.substr(0, equals), value};
    }
    throw UsageError(fmt::format("--param: found \"{}\", expected NAME=NUMBER", text));
}

BakedTextureOptions make_options(const BakeArguments& arguments) {
    BakedTextureOptions options;
    for (const std::string& text : arguments.parameters)
        options.parameters.insert(parse_parameter(text));
    options.threads = arguments.threads;
    options.disk = !arguments.no_cache;
    options.must_keep = arguments.output.empty() && arguments.packed.empty();
    options.seconds_limit = std::numeric_limits<double>::infinity();
    return options;
}

/// Before long work.
void check_arguments(const BakeArguments& arguments, BakeKind kind, Packing packing) {
    check_output_kinds({{"-o", ".exr", arguments.output}});
    const bool png = std::filesystem::path(arguments.packed).extension() == ".png";
    check_output_kinds({{"--packed", png ? ".png" : ".exr", arguments.packed}});
    if (arguments.output.empty() && arguments.packed.empty() && arguments.no_cache)
        throw UsageError("bake has nothing to write: give -o, --packed or leave out --no-cache");
    if (bakes_layers(kind) && arguments.channel != "r")
        throw UsageError(
            fmt::format("--channel: found \"{}\", expected none: {} maps are made of "
                        "all channels",
                        arguments.channel, arguments.kind));
    if (!std::isfinite(arguments.border))
        throw UsageError(fmt::format("--border: found {}, expected a number", arguments.border));
    if (!arguments.packed.empty() && !is_packable(kind, packing))
        throw UsageError(
            fmt::format("{} maps have no packing \"{}\"", arguments.kind, arguments.packing));
}

void check_files(const BakeArguments& arguments) {
    CommandFiles files;
    files.add_input(arguments.image);
    files.add_output("-o", arguments.output);
    files.add_output("--packed", arguments.packed);
    files.check_writable();
}

std::shared_ptr<const Texture> bake_with_bar(const Texture& height, BakeKind kind,
                                             const SamplerState& sampler,
                                             BakedTextureOptions options) {
    ProgressBar bar;
    options.progress = [&bar](double share) { bar.show(share); };
    options.not_kept = [&bar](const std::string& reason) { say_not_kept(reason, bar); };
    return baked_texture(height, kind, sampler, options);
}

/// Of a mesh, with nothing that a height field takes.
ExitCode run_layers(const BakeArguments& arguments) {
    if (arguments.layers.mesh.empty())
        throw UsageError(fmt::format("--kind {} expects --mesh MESH", depth_layers_kind));
    if (!arguments.image.empty())
        throw UsageError(
            fmt::format("found \"{}\", expected no height field: {} are made of --mesh",
                        arguments.image, depth_layers_kind));
    if (!arguments.packed.empty())
        throw UsageError(
            fmt::format("{} maps have no packing \"{}\"", depth_layers_kind, arguments.packing));
    if (!arguments.parameters.empty())
        throw UsageError(fmt::format("{} maps have no parameters; found \"{}\"", depth_layers_kind,
                                     arguments.parameters.front()));
    if (arguments.output.empty())
        throw UsageError(fmt::format("--kind {} expects -o OUT.exr", depth_layers_kind));
    LayerArguments layers = arguments.layers;
    layers.output = arguments.output;
    layers.compression = arguments.compression;
    layers.threads = arguments.threads;
    return bake_layers(layers);
}

/// Tables by direction grow with each of their dimensions: what one takes.
void say_memory(BakeKind kind, const Texture& map) {
    if (kind != BakeKind::ddm && kind != BakeKind::gdm && kind != BakeKind::vdm) return;
    const TextureView& view = map.view();
    double texels = 0;
    for (int level = 0; level < view.levels; ++level)
        texels += static_cast<double>(view.width[level]) * view.height[level] * view.faces;
    const int directions = view.width[0] / view.width[1];
    tell(fmt::format("quadrel: {} x {} columns, {} {}, {} x {} directions: {:.2g} MiB of memory",
                     view.width[1], view.height[1], view.faces,
                     kind == BakeKind::vdm ? "curvatures" : "slices", directions, directions,
                     texels * sizeof(float) / (1 << 20)));
}

ExitCode run_bake(const BakeArguments& arguments) {
    if (arguments.kind == depth_layers_kind) return run_layers(arguments);
    if (!arguments.layers.mesh.empty())
        throw UsageError(fmt::format("--mesh: expected with --kind {}, found --kind {}",
                                     depth_layers_kind, arguments.kind));
    if (arguments.image.empty()) throw UsageError("bake expects a height field: heights");
    const BakeKind kind = bake_kind_from_name(arguments.kind);
    const BakedTextureOptions options = make_options(arguments);
    if (const auto hint = threads_hint(arguments.threads)) tell("quadrel: " + *hint);
    const Packing packing = packing_from_name(arguments.packing, kind);
    check_arguments(arguments, kind, packing);
    check_files(arguments);
    const auto height = load_heights(arguments, kind);
    const SamplerState sampler = make_sampler(arguments);
    const auto map = bake_with_bar(*height, kind, sampler, options);
    const ExrWriting writing{arguments.compression, arguments.threads};
    OutputGroup outputs;
    if (!arguments.output.empty())
        write_baked(arguments.output, *map, *height, kind, sampler, options, writing);
    if (!arguments.packed.empty())
        write_packed(
            arguments.packed, *map, *height, sampler, packing,
            arguments.rounding == "nearest" ? PackRounding::nearest : PackRounding::conservative,
            writing);
    outputs.commit();
    for (const std::string& output : {arguments.output, arguments.packed})
        if (!output.empty()) say_written(output);
    say_memory(kind, *map);
    return ExitCode::ok;
}

/// The kinds and their parameters, for the end of the help text.
std::string describe_kinds() {
    std::string text = fmt::format("Kinds:\n  {:<20}{}\n", depth_layers_kind,
                                   "sorted depths of a closed mesh, of --mesh in place of heights");
    for (const BakeKindInfo& info : bake_kinds()) {
        text += fmt::format("  {:<20}{}\n", info.name, info.text);
        for (const BakeParameter& p : info.parameters)
            text += fmt::format("  {:<20}  {}={}: {}\n", "", p.name, p.standard, p.text);
    }
    return text;
}

void add_field(CLI::App& verb, BakeArguments& a) {
    const CLI::Validator modes = one_word_of(wrap_modes());
    verb.add_option("heights", a.image, "image of any format that textures may have");
    add_selection_options(verb, a.selection);
    verb.add_option("--channel", a.channel,
                    "where the heights are: r, g, b, a, or 1-r ... for depth; alpha-or-first: a "
                    "where the image has it, else r")
        ->check(one_word_of(std::vector<std::string>{"r", "g", "b", "a", "1-r", "1-g", "1-b", "1-a",
                                                     alpha_or_first}))
        ->capture_default_str();
    verb.add_option("--wrap-u", a.wrap_u, "how the field goes on")
        ->check(modes)
        ->capture_default_str();
    verb.add_option("--wrap-v", a.wrap_v, "how the field goes on")
        ->check(modes)
        ->capture_default_str();
    verb.add_option("--wrap", a.wrap, "both of them")->check(modes);
    verb.add_option("--border", a.border, "height outside with clamp-to-border")
        ->capture_default_str();
    std::vector<std::string> formats;
    for (const auto& [name, format] : named_formats) formats.emplace_back(name);
    verb.add_option("--format", a.format, "what texels are rounded to; the file's own if absent")
        ->check(one_word_of(formats));
    verb.add_flag("--flip-v", a.flip_v, "last row first");
}

void add_mesh(CLI::App& verb, LayerArguments& a) {
    verb.add_option("--mesh", a.mesh,
                    "depth-layers: a closed mesh, .obj .gltf .glb, or cube icosahedron "
                    "sphere torus")
        ->type_name("MESH");
    verb.add_option("--size", a.size, "depth-layers: texels")
        ->type_name("WxH")
        ->capture_default_str();
    verb.add_option("--towards", a.towards, "depth-layers: the way of depth, x,y,z")
        ->type_name("X,Y,Z")
        ->capture_default_str();
    verb.add_option("--margin", a.margin,
                    "depth-layers: tiles left free on the mesh's longer side, [0, 0.5)")
        ->capture_default_str();
    verb.add_option("--solids", a.solids,
                    "depth-layers: solids behind each other, 1 to 6; from the third on as layers "
                    "\"second\" and \"third\" of the file")
        ->capture_default_str();
}

void add_outputs(CLI::App& verb, BakeArguments& a) {
    verb.add_option("-o,--output", a.output, "EXR to write (without it the map is cached only)")
        ->type_name("OUT.exr");
    verb.add_option("--packed", a.packed,
                    "also write .png (8 bits) or .exr in the channels of the source")
        ->type_name("OUT");
    verb.add_option("--packing", a.packing,
                    "dummer: height, root of the cone; gg3: normal x y, cone, depth")
        ->capture_default_str();
    verb.add_option("--rounding", a.rounding, "of packed values")
        ->check(one_word_of(std::vector<std::string>{"conservative", "nearest"}))
        ->capture_default_str();
    add_compression_option(verb, a.compression);
    verb.add_flag("--no-cache", a.no_cache, "neither read nor write the disk cache");
}

}  // namespace

void add_bake(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("bake", "derive a map from a height field or a mesh");
    const auto a = std::make_shared<BakeArguments>();
    add_field(*verb, *a);
    verb->add_option("--kind", a->kind, "what to derive, see below")->required();
    verb->add_option("--param", a->parameters, "of the kind; repeatable")
        ->type_name("NAME=NUMBER")
        ->allow_extra_args(false);
    add_mesh(*verb, a->layers);
    add_outputs(*verb, *a);
    add_quiet_option(*verb);
    verb->add_option("-t,--threads", a->threads,
                     "threads; 0: as many as there are CPUs, more are obeyed")
        ->check(whole_number(0, 1024))
        ->capture_default_str();
    verb->footer(describe_kinds());
    verb->callback([a, &action] { action = [a] { return run_bake(*a); }; });
}

}  // namespace quadrel::cli
