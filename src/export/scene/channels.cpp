#include "export/scene/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "render/plan/plan.hpp"

namespace quadrel {
namespace {

using Kind = ProgramChannel::Kind;

/// Values that some stage of the scene's materials stores.
ValueSet stored_values(const Scene& scene) {
    ValueSet stored;
    for (const Material& material : scene.materials)
        for (const PlannedStage& stage : material_stages(scene, material))
            for (const Value v : stage.info->outputs) stored.set(static_cast<std::size_t>(v));
    return stored;
}

/// Whether a search turns the frame, so that what shades and shadows the hit reads another one than
/// the search itself.
bool has_turned_frame(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& of) {
        const std::vector<PlannedStage> stages = material_stages(scene, of);
        return std::count_if(stages.begin(), stages.end(), [](const PlannedStage& stage) {
                   return stores(stage, Value::frame_normal);
               }) > 1;
    });
}

/// Those of values, in the order of the data flow.
std::vector<std::string> names_of_values(int lights, bool turned_frame) {
    std::vector<std::string> names;
    for (const char* group : {"uv", "P", "Ng", "dUVdx", "dUVdy", "dPdx", "dPdy", "relief.depth",
                              "T", "J", "r", "K", "hit", "frag.depth", "N"})
        for (const std::string& name : expand_channels(std::vector<std::string>{group}))
            names.push_back(name);
    // "B" is blue.
    const auto after_t = std::find(names.begin(), names.end(), "T.Z") + 1;
    const char* const bitangent[] = {"B.X", "B.Y", "B.Z"};
    names.insert(after_t, std::begin(bitangent), std::end(bitangent));
    if (turned_frame)
        for (const std::string& name : expand_channels(std::vector<std::string>{"frame_normal"}))
            names.push_back(name);
    for (int light = 0; light < lights; ++light)
        for (const char* what : {"visibility", "steps"})
            names.push_back(light == 0 ? fmt::format("shadow.{}", what)
                                       : fmt::format("shadow.{}.{}", light, what));
    for (const char* group : {"occlusion", "light", "R", "G", "B"})
        for (const std::string& name : expand_channels(std::vector<std::string>{group}))
            names.push_back(name);
    return names;
}

bool has_map_with_lod(const Scene& scene) {
    return std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& of) {
        return (of.textures.count("height") != 0) || of.textures.count("color") != 0;
    });
}

std::uint32_t clear_bits(const Scene& scene, const ChannelSource& source) {
    if (source.kind != ChannelSource::Kind::value || source.value != Value::color)
        return uncovered_bits(source.name);
    return std::bit_cast<std::uint32_t>(scene.background[source.component]);
}

ProgramChannel program_channel(const ChannelSource& source) {
    ProgramChannel channel{Kind::none, source.value, source.light, source.component};
    if (source.kind == ChannelSource::Kind::coverage) channel.kind = Kind::coverage;
    if (source.kind == ChannelSource::Kind::z) channel.kind = Kind::z;
    if (source.kind != ChannelSource::Kind::value) return channel;
    if (source.value == Value::lod_level)
        channel.kind = Kind::lod_level;
    else if (source.value == Value::lod_lambda)
        channel.kind = Kind::lod_lambda;
    else if (source.value != Value::lod_rho && source.value != Value::lod_frac &&
             source.value != Value::bary)
        channel.kind = Kind::value;
    return channel;
}

}  // namespace

std::vector<std::string> exportable_channels(const Scene& scene, const std::string& language) {
    const ValueSet stored = stored_values(scene);
    std::vector<std::string> names;
    for (const std::string& name :
         names_of_values(static_cast<int>(scene.lights.size()), has_turned_frame(scene))) {
        const ChannelSource source = channel_source(name);
        if (stored[static_cast<std::size_t>(source.value)]) names.push_back(name);
        const bool asks_lod = name == "dUVdy.V" && language != "glsl-es" && language != "wgsl";
        if (asks_lod && has_map_with_lod(scene)) {
            names.emplace_back("lod.lambda");
            names.emplace_back("lod.level");
        }
    }
    names.emplace_back("A");
    names.emplace_back("Z");
    return names;
}

std::vector<ExportedChannel> exported_channels(const Scene& scene,
                                               const std::vector<std::string>& names) {
    std::vector<ExportedChannel> channels;
    for (const std::string& name : names) {
        const ChannelSource source = channel_source(name);
        const ProgramChannel of = program_channel(source);
        if (of.kind == Kind::none)
            throw UsageError(
                fmt::format("--channels: found \"{}\", expected what a shader can tell of the "
                            "scene: {}",
                            name, fmt::join(exportable_channels(scene, "glsl"), " ")));
        if (source.light > 0 && source.light >= static_cast<int>(scene.lights.size()))
            throw UsageError(fmt::format("--channels: found \"{}\", expected one of {} lights",
                                         name, scene.lights.size()));
        // By whatever name, once.
        if (std::none_of(channels.begin(), channels.end(),
                         [&](const ExportedChannel& known) { return known.source == of; }))
            channels.push_back({name, source.type, of, clear_bits(scene, source)});
    }
    return channels;
}

namespace {

/// What channels of one vector have in common.
std::string vector_of_channel(const std::string& name) {
    static const std::string suffixes = "XYZUVRGB";
    if (suffixes.find(name.back()) == std::string::npos) return name;
    if (name.size() == 1) return "color";
    return name[name.size() - 2] == '.' ? name.substr(0, name.size() - 2) : name;
}

struct Target {
    ProgramChannel channels[4];
    std::size_t used = 0;
};

/// Vectors one after the other, each into the first target that has room for all of it.
std::vector<Target> targets_of(const std::vector<ExportedChannel>& channels) {
    std::vector<Target> targets;
    for (std::size_t first = 0, end = 0; first < channels.size(); first = end) {
        const std::string vector = vector_of_channel(channels[first].name);
        while (end < channels.size() && end < first + 4 &&
               vector_of_channel(channels[end].name) == vector)
            ++end;
        auto target = std::find_if(targets.begin(), targets.end(),
                                   [&](const Target& of) { return of.used + (end - first) <= 4; });
        if (target == targets.end()) target = targets.emplace(target);
        for (std::size_t c = first; c < end; ++c)
            target->channels[target->used++] = channels[c].source;
    }
    return targets;
}

}  // namespace

std::vector<ProgramPass> passes_of(const std::vector<ExportedChannel>& channels, int targets) {
    std::vector<ProgramPass> passes;
    for (const Target& target : targets_of(channels)) {
        if (passes.empty() || passes.back().target_count == targets) passes.emplace_back();
        ProgramPass& pass = passes.back();
        std::copy_n(target.channels, 4, pass.channels[pass.target_count++]);
    }
    return passes;
}

const ExportedChannel& channel_of(const std::vector<ExportedChannel>& channels,
                                  const ProgramChannel& source) {
    return *std::find_if(channels.begin(), channels.end(),
                         [&](const ExportedChannel& of) { return of.source == source; });
}

// OpenGL ES 3.0, table 6.31: 4 draw buffers at least; OpenGL 3.3 and Direct3D 11: 8. WebGPU: 32
// bytes per sample (maxColorAttachmentBytesPerSample), of which four floats are 16.
int targets_at_once(const std::string& language) {
    if (language == "wgsl") return 2;
    return language == "glsl-es" ? 4 : 8;
}

}  // namespace quadrel
