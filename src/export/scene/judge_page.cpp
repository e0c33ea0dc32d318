#include "export/scene/judge_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "export/scene/content.hpp"
#include "export/scene/manifest.hpp"
#include "page/bits.hpp"
#include "page/template.hpp"
#include "page/view.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/prepare.hpp"
#include "render/ranges/limits.hpp"
#include "render/ranges/range_plan.hpp"
#include "rules/page.hpp"

namespace quadrel {
namespace {

constexpr const char* page_language = "glsl-es";

/// Elements that lie one after the other, `parts` of them a record (a vertex, a texel): first those
/// of all first parts, then of all second ones, so that neighbours are alike.
template <class Element>
std::vector<std::uint32_t> words_by_part(const std::string& bytes, std::size_t parts) {
    const std::size_t count = bytes.size() / sizeof(Element), records = count / parts;
    std::vector<std::uint32_t> words(count);
    for (std::size_t i = 0; i < count; ++i) {
        Element element;
        std::memcpy(&element, bytes.data() + i * sizeof(Element), sizeof element);
        words[i % parts * records + i / parts] = element;
    }
    return words;
}

/// `elements` is what the page makes of them: uint8, uint16, uint32, float32, or unorm16, codes
/// that it turns into floats.
Json packed_entry(const char* elements, const std::vector<std::uint32_t>& words, std::size_t parts,
                  std::size_t width) {
    return {{"elements", elements},
            {"parts", parts},
            {"count", words.size()},
            {"bits", page::packed_bits(words, {}, width)}};
}

Json packed_level(const ContentTexture& texture, int level) {
    TexelLayout layout = texture.layout;
    // Codes take less room than the floats that OpenGL ES gets in their place.
    const bool codes =
        layout.format == TexelFormat::float32 && texture.texture->format() == TexelFormat::unorm16;
    if (codes) layout.format = TexelFormat::unorm16;
    const std::string bytes = texture.bytes(level, layout);
    const auto parts = static_cast<std::size_t>(layout.channels);
    const auto width = static_cast<std::size_t>(texture.side(level).width);
    switch (layout.format) {
        case TexelFormat::unorm8:
        case TexelFormat::srgb8:
            return packed_entry("uint8", words_by_part<std::uint8_t>(bytes, parts), parts, width);
        case TexelFormat::unorm16:
        case TexelFormat::half:
            return packed_entry(codes ? "unorm16" : "uint16",
                                words_by_part<std::uint16_t>(bytes, parts), parts, width);
        case TexelFormat::float32:
            break;
    }
    return packed_entry("float32", words_by_part<std::uint32_t>(bytes, parts), parts, width);
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void add_shaders(const ExportContent& content, Json& files) {
    for (const ContentMaterial& material : content.materials) {
        files[material.vertex_file(content.language)] = material.program.vertex;
        files[material.fragment_file(content.language)] = material.program.fragment;
    }
}

void add_bytes(const ExportContent& content, Json& files) {
    const auto floats = static_cast<std::size_t>(content.buffers.floats_a_vertex());
    files["vertices.bin"] = packed_entry(
        "float32", words_by_part<std::uint32_t>(bytes_of(content.buffers.vertices), floats), floats,
        0);
    files["indices.bin"] = packed_entry(
        "uint32", words_by_part<std::uint32_t>(bytes_of(content.buffers.indices), 3), 3, 0);
    for (const ContentTexture& texture : content.textures)
        for (int level = 0; level < texture.levels; ++level)
            files[texture.bytes_file(level)] = packed_level(texture, level);
}

/// Without what is of a folder alone.
Json description_of(const ExportContent& content) {
    Json description = manifest_of(content);
    description.erase("expected");
    for (Json& texture : description["textures"])
        for (Json& level : texture["levels"]) level.erase("exr");
    return description;
}

/// What WebGPU draws the scene by, as far as it is other than `description`, which has all `data`;
/// or {"refusal": why it can't}.
Json webgpu_description(const ExportContent& content, const Json& description) {
    try {
        const ExportContent other = content_in(content, "wgsl");
        Json own = description_of(other), data = Json::object();
        add_shaders(other, data);
        if (own["textures"] != description["textures"] ||
            own["vertex_buffer"] != description["vertex_buffer"])
            add_bytes(other, data);
        Json differs;
        for (const auto& [key, value] : own.items())
            if (!description.contains(key) || description[key] != value) differs[key] = value;
        differs["data"] = data;
        return differs;
    } catch (const UsageError& error) {
        const std::string reason = error.what(), option = "--language wgsl: ";
        return {{"refusal", reason.starts_with(option) ? reason.substr(option.size()) : reason}};
    }
}

/// Channels that can have a range, and why others have none; empty where all have.
struct RangedChannels {
    std::vector<std::string> names;
    std::string refusal;
};

RangedChannels ranged_channels(const Scene& scene, const std::vector<ExportedChannel>& channels,
                               const std::string& limits) {
    RangedChannels ranged;
    for (const ExportedChannel& channel : channels) {
        if (!has_range(channel.name)) continue;
        try {
            plan_ranges(scene, {channel_source("gpu.lo." + channel.name)}, RangeSet::gpu, limits);
            ranged.names.push_back(channel.name);
        } catch (const UsageError& error) {
            if (ranged.refusal.empty()) ranged.refusal = error.what();
        }
    }
    return ranged;
}

/// Of pixels that are not judged: what a page shows in no verdict.
constexpr std::uint32_t not_judged = 0xffffffffu;

/// Planes for all of the frame: each value alone, and not judged.
void add_empty_ranges(const std::vector<std::string>& names, Film& film) {
    for (const std::string& name : names) {
        for (const char* end : {"gpu.lo.", "gpu.hi.", "gpu.gap.lo.", "gpu.gap.hi."}) {
            const std::vector<std::uint32_t> values = film.find(name)->bits;
            film.add(end + name, ChannelType::float32).bits = values;
        }
        film.add("gpu.paths." + name, ChannelType::uint32, not_judged);
    }
}

/// Rows of `part` into the film's planes of the same names.
void take_ranges(const Film& part, Film& film) {
    for (const Plane& plane : part.planes)
        if (Plane* const own = plane.name.starts_with("gpu.") ? film.find(plane.name) : nullptr)
            std::ranges::copy(plane.bits, own->bits.begin() + static_cast<std::ptrdiff_t>(
                                                                  film.index(0, part.window.y0)));
}

/// Where there is no gap, both of its ends are the value, which takes no room in a page.
void empty_gaps(const std::vector<std::string>& names, Film& film) {
    for (const std::string& name : names) {
        const Plane& values = *film.find(name);
        Plane &low = *film.find("gpu.gap.lo." + name), &high = *film.find("gpu.gap.hi." + name);
        for (std::size_t i = 0; i < values.bits.size(); ++i)
            if (!(low.as_float(i) < high.as_float(i))) low.bits[i] = high.bits[i] = values.bits[i];
    }
}

void add_ranges(const Scene& scene, const JudgePage& options, const RangedChannels& ranged,
                Film& film) {
    if (ranged.names.empty()) return;
    add_empty_ranges(ranged.names, film);
    RenderOptions render;
    render.channels = ranged.names;
    render.limits = options.limits;
    render.threads = options.scene.threads;
    render.baking_limit = options.scene.baking_limit;
    render.tile = 16;  // for rows of quads, too, are to keep all threads busy
    if (options.every == 1) render.progress = options.scene.progress;
    PreparedScene prepared(scene, render);
    const int height = options.every == 1 ? scene.height : 2;
    for (int y = 0; y < scene.height; y += height * options.every) {
        prepared.options().window = Window{0, y, scene.width, std::min(y + height, scene.height)};
        take_ranges(prepared.draw(), film);
        if (options.every > 1 && options.scene.progress)
            options.scene.progress(static_cast<double>(y) / scene.height);
    }
    empty_gaps(ranged.names, film);
}

page::ViewSource reference_of(const ExportContent& content, Film film) {
    page::ViewSource source{"Quadrel", {}};
    for (const Plane& plane : film.planes)
        source.image.stored[plane.name] =
            plane.type == ChannelType::uint32 ? Storage::uint32 : Storage::float32;
    source.image.film = std::move(film);
    source.image.attributes = content.expected_attributes;
    return source;
}

/// What OpenGL tells of the scene and no browser does.
std::vector<std::string> lacking_channels(const Scene& scene) {
    std::vector<std::string> names = exportable_channels(scene, "glsl");
    const std::vector<std::string> known = exportable_channels(scene, page_language);
    std::erase_if(names,
                  [&](const std::string& name) { return std::ranges::count(known, name) != 0; });
    return names;
}

bool is_judged(const std::string& name) {
    static constexpr const char* names[] = {
        "uv.U",  "uv.V", "dUVdx.U", "dUVdx.V", "dUVdy.U", "dUVdy.V", "K.U", "K.V", "hit.U",
        "hit.V", "N.X",  "N.Y",     "N.Z",     "R",       "G",       "B",   "A",   "hit.status"};
    return std::ranges::count(names, name) != 0 ||
           (name.starts_with("shadow.") && name.ends_with("visibility"));
}

}  // namespace

std::vector<std::string> judged_channels(const Scene& scene) {
    std::vector<std::string> names = exportable_channels(scene, page_language);
    std::erase_if(names, [](const std::string& name) { return !is_judged(name); });
    return names;
}

std::string judge_page(const Scene& scene, const JudgePage& options) {
    if (scene.samples > 1)
        throw UsageError(fmt::format(
            "--page: found {} samples per pixel, expected one (-D samples=1)", scene.samples));
    if (!options.limits.empty()) budget_of_limits(options.limits);  // throws for what is none
    SceneExport plain = options.scene;
    plain.language = page_language;
    plain.reference = true;
    if (plain.channels.empty()) plain.channels = judged_channels(scene);
    const ExportContent content = export_content(scene, plain);
    RangedChannels ranged;
    if (!options.limits.empty()) ranged = ranged_channels(scene, content.channels, options.limits);
    Film film = content.expected;
    add_ranges(scene, options, ranged, film);
    return judge_page_of(content, std::move(film), options, ranged.refusal);
}

std::string judge_page_of(const ExportContent& content, Film reference, const JudgePage& options,
                          const std::string& refusal) {
    Json description = description_of(content), data;
    add_shaders(content, data);
    add_bytes(content, data);
    const Json webgpu = webgpu_description(content, description);
    description["limits"] = options.limits;
    description["refusal"] = refusal;
    description["every"] = options.every;
    description["pack"] = page::page_part("snippets/pack.glsl");
    description["data"] = data;
    description["rules"] = rules::probes_for_page();
    description["webgpu"] = webgpu;
    description["lacking"] = lacking_channels(*content.scene);
    return page::judge_html(reference_of(content, std::move(reference)), description,
                            content.scene->file.stem().string() + " on this GPU");
}

}  // namespace quadrel
