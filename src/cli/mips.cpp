// quadrel mips: the mip levels of an image as files, for ports that upload the very texels.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "cli/common/command_files.hpp"
#include "cli/common/compression_option.hpp"
#include "cli/common/console.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/common/validators.hpp"
#include "cli/verbs.hpp"
#include "file/output_group.hpp"
#include "film/image_film.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/texture/texture.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::cli {
namespace {

const std::map<std::string, TexelFormat> formats = [] {
    std::map<std::string, TexelFormat> by_name;
    for (const auto& [name, format] : named_formats) by_name.emplace(name, format);
    return by_name;
}();
const std::map<std::string, MipRule> rules{{"box", MipRule::box}, {"area", MipRule::area}};

struct MipsArguments {
    std::string image, prefix, format, rule = "box", swizzle;
    ImageSelection selection;
    ExrCompression compression = ExrCompression::zip;
    bool srgb = false, flip_v = false;
};

TextureOptions texture_options(const MipsArguments& arguments) {
    TextureOptions options;
    options.swizzle = arguments.swizzle;
    options.srgb = arguments.srgb;
    options.flip_v = arguments.flip_v;
    options.mip_rule = rules.at(arguments.rule);
    if (!arguments.format.empty()) options.format = formats.at(arguments.format);
    return options;
}

/// A swizzle says what its channels are: a single one is a scalar, the others are colours.
bool is_gray(const Image& image, const MipsArguments& arguments, int channels) {
    return channels == 1 || (arguments.swizzle.empty() && image.luminance && channels == 2);
}

std::vector<std::string> level_files(const MipsArguments& arguments, int levels) {
    std::vector<std::string> files;
    for (int level = 0; level < levels; ++level)
        files.push_back(fmt::format("{}.{}.exr", arguments.prefix, level));
    return files;
}

ExitCode run_mips(const MipsArguments& arguments) {
    CommandFiles all;
    const Image image = load_image(arguments.image, NotFinite::refuse, "", arguments.selection);
    const auto texture = make_texture(image, texture_options(arguments));
    const bool gray = is_gray(image, arguments, texture->view().channels);
    const std::vector<std::string> files = level_files(arguments, texture->view().levels);
    if (arguments.prefix == "-") throw UsageError("-o: found -, expected how names begin");
    for (const std::string& file : files) all.add_output("-o", file);
    all.check_writable();
    OutputGroup outputs;
    for (int level = 0; level < texture->view().levels; ++level)
        write_exr(
            files[static_cast<std::size_t>(level)],
            image_film(texture_level(*texture, level), gray),
            {{"quadrel:mipLevel", fmt::format("{}", level)}, {"quadrel:mipRule", arguments.rule}},
            {arguments.compression});
    outputs.commit();
    for (const std::string& file : files) say_written(file);
    return ExitCode::ok;
}

}  // namespace

void add_mips(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("mips", "write the mip levels of an image as EXR");
    const auto a = std::make_shared<MipsArguments>();
    verb->add_option("image", a->image, "image of any format that textures may have")->required();
    verb->add_option("-o,--output", a->prefix, "levels go to PREFIX.0.exr, PREFIX.1.exr, ...")
        ->type_name("PREFIX")
        ->required();
    add_selection_options(*verb, a->selection);
    verb->add_option("--format", a->format, "round each level to this (default: the file's)")
        ->check(one_word_of(formats));
    verb->add_option("--rule", a->rule, "reduction")
        ->check(one_word_of(rules))
        ->capture_default_str();
    verb->add_option("--swizzle", a->swizzle, "channels, as in scene files: rgba, a, 1-r, ...");
    verb->add_flag("--srgb", a->srgb, "colour channels are sRGB-encoded: filter linear values");
    verb->add_flag("--flip-v", a->flip_v, "last row first");
    add_compression_option(*verb, a->compression);
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_mips(*a); }; });
}

}  // namespace quadrel::cli
