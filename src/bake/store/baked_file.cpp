#include "quadrel/bake/baked_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>

#include "bake/kinds.hpp"
#include "bake/layout.hpp"
#include "bake/wrap_names.hpp"
#include "io/exr/parts.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel {

namespace {

/// What a file says about itself; what a loader compares.
Attributes describe(const Texture& height, BakeKind kind, const SamplerState& sampler) {
    const BakeKindInfo& info = bake_kind_info(kind);
    Attributes attributes{{"quadrel:bake.kind", info.name},
                          {"quadrel:bake.version", fmt::format("{}", info.version)},
                          {"quadrel:bake.wrapU", wrap_name(sampler.wrap_u)},
                          {"quadrel:bake.wrapV", wrap_name(sampler.wrap_v)},
                          {"quadrel:bake.heightSha256", source_id(height, kind)}};
    if (has_border(sampler))
        attributes["quadrel:bake.border"] = fmt::format("{}", sampler.border[0]);
    return attributes;
}

/// And what is told besides.
Attributes describe_all(const Texture& map, const Texture& height, BakeKind kind,
                        const SamplerState& sampler, const BakeOptions& options) {
    const BakeKindInfo& info = bake_kind_info(kind);
    Attributes all = describe(height, kind, sampler);
    all["quadrel:bake.field"] = info.field;
    all["quadrel:bake.metric"] = info.metric;
    all["quadrel:bake.rounding"] = info.rounding;
    all["quadrel:bake.id"] = map.id();
    all["quadrel:bake.heightSize"] =
        fmt::format("{}x{}", height.view().width[0], height.view().height[0]);
    all["quadrel:bake.layers"] = fmt::format("{}", map.view().faces);
    all["quadrel:bake.channels"] = fmt::format("{}", map.view().channels);
    for (const auto& [name, value] : complete_parameters(info, options))
        all["quadrel:bake.parameter." + name] = fmt::format("{}", value);
    return all;
}

std::string channel_name(int channels, int layers, int layer, int c) {
    const std::string name(1, channels == 1 ? 'Y' : "RGBA"[c]);
    return layers == 1 ? name : fmt::format("{:03}.{}", layer, name);
}

/// A level of all layers; every level has the frame of the first, as parts of one file must.
Film to_film(const Texture& map, int level) {
    const TextureView& view = map.view();
    Film film;
    film.frame = {0, 0, view.width[0], view.height[0]};
    film.window = {0, 0, view.width[level], view.height[level]};
    for (int layer = 0; layer < view.faces; ++layer) {
        const float* texels = map.level_texels(level, layer);
        for (int c = 0; c < view.channels; ++c) {
            Plane& plane =
                film.add(channel_name(view.channels, view.faces, layer, c), ChannelType::float32);
            for (std::size_t i = 0; i < plane.bits.size(); ++i)
                plane.bits[i] = std::bit_cast<std::uint32_t>(texels[i * view.channels + c]);
        }
    }
    return film;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& key,
                         const std::string& found, const std::string& expected) {
    throw InputError(file.string(), key, found, expected);
}

/// Whether the file was made for this field, or InputError.
void check_attributes(const std::filesystem::path& file, const std::string& key,
                      const Attributes& found, const Attributes& expected) {
    if (found.count("quadrel:bake.kind") == 0) refuse(file, key, "no baked map", "one");
    // The kind first: of another kind nothing else can be compared.
    for (const char* name :
         {"quadrel:bake.kind", "quadrel:bake.version", "quadrel:bake.wrapU", "quadrel:bake.wrapV",
          "quadrel:bake.border", "quadrel:bake.heightSha256"}) {
        const auto of = [&](const Attributes& attributes) {
            const auto at = attributes.find(name);
            return at == attributes.end() ? std::string("none") : at->second;
        };
        if (of(found) == of(expected)) continue;
        refuse(file, key, fmt::format("a map baked with {} {}", name + 13, of(found)),
               fmt::format("{} {}", name + 13, of(expected)));
    }
}

int read_number(const std::filesystem::path& file, const std::string& key,
                const Attributes& attributes, const std::string& name, int high) {
    const auto at = attributes.find(name);
    const std::string text = at == attributes.end() ? "" : at->second;
    const bool digits = !text.empty() && text.size() < 6 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    const int number = digits ? std::stoi(text) : 0;
    if (number < 1 || number > high)
        refuse(file, key, fmt::format("{} \"{}\"", name, text), fmt::format("1 to {}", high));
    return number;
}

/// The parameters that the map was made with; they are part of its identity.
BakeOptions read_options(const std::filesystem::path& file, const std::string& key,
                         const Attributes& attributes, const BakeKindInfo& info) {
    BakeOptions options;
    for (const BakeParameter& p : info.parameters) {
        const auto at = attributes.find(std::string("quadrel:bake.parameter.") + p.name);
        const std::string text = at == attributes.end() ? "" : at->second;
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        const bool number = error == std::errc() && stop == end && value >= p.low &&
                            value <= p.high && (!p.whole || value == std::floor(value));
        if (!number)
            refuse(file, key, fmt::format("parameter {} \"{}\"", p.name, text),
                   fmt::format("{} to {}", p.low, p.high));
        options.parameters[p.name] = value;
    }
    return options;
}

void fill_level(const std::filesystem::path& file, const std::string& key, const Film& film,
                int level, Texture& map) {
    const TextureView& view = map.view();
    for (int layer = 0; layer < view.faces; ++layer) {
        float* texels = map.level_texels(level, layer);
        for (int c = 0; c < view.channels; ++c) {
            const std::string name = channel_name(view.channels, view.faces, layer, c);
            const Plane* const plane = film.find(name);
            if (plane == nullptr || plane->type != ChannelType::float32)
                refuse(file, key, "no channel " + name, "every channel of the map");
            for (std::size_t i = 0; i < plane->bits.size(); ++i)
                texels[i * view.channels + c] = plane->as_float(i);
        }
    }
}

}  // namespace

void write_baked(const std::filesystem::path& file, const Texture& map, const Texture& height,
                 BakeKind kind, const SamplerState& sampler, const BakeOptions& options,
                 const ExrWriting& writing) {
    std::vector<ExrPart> parts;
    const Attributes attributes = describe_all(map, height, kind, sampler, options);
    for (int level = 0; level < map.view().levels; ++level)
        parts.push_back({fmt::format("level{}", level), to_film(map, level), attributes});
    write_exr_parts(file, parts, writing);
}

std::shared_ptr<const Texture> load_baked(const std::filesystem::path& file, BakeKind kind,
                                          const SamplerState& sampler, const Texture& height,
                                          const std::string& key) {
    std::vector<ExrFile> levels{read_exr(file, {"", "0"})};
    const Attributes attributes = levels[0].attributes;
    check_attributes(file, key, attributes, describe(height, kind, sampler));
    const std::size_t count = levels[0].parts.size();
    if (count > max_mip_levels) refuse(file, key, fmt::format("{} parts", count), "17 at most");
    for (std::size_t level = 1; level < count; ++level)
        levels.push_back(read_exr(file, {"", fmt::format("level{}", level)}));
    std::vector<LevelSize> sizes;
    const int channels = read_number(file, key, attributes, "quadrel:bake.channels", 4);
    const int layers = read_number(file, key, attributes, "quadrel:bake.layers", 1024);
    for (const ExrFile& level : levels) {
        // Before room is made for what a damaged header claims.
        const std::size_t planes = static_cast<std::size_t>(channels) * layers;
        if (level.film.planes.size() != planes || channels == 3)
            refuse(file, key, fmt::format("{} channels", level.film.planes.size()),
                   fmt::format("{} layers of {}", layers, channels));
        sizes.emplace_back(level.film.window.width(), level.film.window.height());
    }
    const auto layout = make_layout(channels, layers, sizes);
    if (!layout) refuse(file, key, "more than a texture holds", "at most 2^29 floats");
    const BakeOptions options = read_options(file, key, attributes, bake_kind_info(kind));
    const auto map = std::make_shared<Texture>(*layout, TexelFormat::float32,
                                               baked_id(height, kind, sampler, options));
    for (int level = 0; level < layout->levels; ++level)
        fill_level(file, key, levels[static_cast<std::size_t>(level)].film, level, *map);
    return map;
}

}  // namespace quadrel
