#include "export/scene/manifest.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bake/wrap_names.hpp"
#include "export/scene/webgpu.hpp"
#include "quadrel/check.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/names.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {
namespace {

/// The fewest digits that read back as the float; what is not finite by name.
Json number(float value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

std::string hex(float value) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", static_cast<double>(value));
    return text;
}

Json uniform_entry(const ProgramName& uniform, const std::vector<float>& values) {
    Json decimal = Json::array(), bits = Json::array();
    for (const float value : values) {
        decimal.push_back(std::isfinite(value) ? number(value) : Json());
        bits.push_back(hex(value));
    }
    return {{"name", uniform.name},
            {"type", uniform.type},
            {"count", uniform.number},
            {"values", decimal},
            {"hex", bits}};
}

/// Of all programs, each once, those that `values` has.
Json uniform_entries(const ExportContent& content, const UniformValues& values) {
    std::map<std::string, Json> entries;
    for (const ContentMaterial& material : content.materials)
        for (const ProgramName& uniform : material.program.uniforms)
            if (const auto found = values.find(uniform.name); found != values.end())
                entries.emplace(uniform.name, uniform_entry(uniform, found->second));
    Json all = Json::array();
    for (const auto& [name, entry] : entries) all.push_back(entry);
    return all;
}

const char* cull_name(Cull cull) {
    return cull == Cull::none ? "none" : cull == Cull::back ? "back" : "front";
}

const char* filter_name(Filter filter) { return filter == Filter::nearest ? "nearest" : "linear"; }

const char* mip_filter_name(MipFilter filter) {
    return filter == MipFilter::none ? "none" : filter == MipFilter::nearest ? "nearest" : "linear";
}

Json state_of(const Scene& scene) {
    const bool symmetric = scene.conventions == Conventions::gl;
    return {{"clip_origin", scene.conventions == Conventions::d3d ? "upper-left" : "lower-left"},
            {"clip_depth", symmetric ? "negative-one-to-one" : "zero-to-one"},
            {"first_row", symmetric ? "bottom" : "top"},
            {"depth_range", {0, 1}},
            {"depth_test", scene.camera.reversed_z ? "greater" : "less"},
            {"depth_clear", scene.camera.reversed_z ? 0 : 1},
            {"front_face", scene.conventions == Conventions::vulkan ? "cw" : "ccw"}};
}

Json vertex_buffer(const VertexBuffers& buffers) {
    Json attributes = Json::array();
    for (const VertexAttribute& attribute : buffers.attributes)
        attributes.push_back({{"name", attribute.name},
                              {"location", attribute.location},
                              {"components", attribute.components},
                              {"offset", attribute.offset},
                              {"meaning", attribute.meaning}});
    const int floats = buffers.floats_a_vertex();
    return {{"file", "vertices.bin"},
            {"stride", floats * static_cast<int>(sizeof(float))},
            {"count", buffers.vertices.size() / static_cast<std::size_t>(std::max(floats, 1))},
            {"attributes", attributes}};
}

Json texture_entry(const ContentTexture& texture, bool decoded) {
    const TextureView& view = texture.texture->view();
    Json levels = Json::array();
    for (int level = 0; level < texture.levels; ++level) {
        Json files = Json::array();
        for (int face = 0; decoded && face < view.faces; ++face)
            files.push_back(texture.exr_file(level, face));
        levels.push_back({{"width", texture.side(level).width},
                          {"height", texture.rows(level)},
                          {"bytes", texture.bytes_file(level)},
                          {"exr", files}});
        if (texture.is_padded()) levels.back()["used"] = {view.width[level], view.height[level]};
    }
    const char* kind = texture.shape == TextureShape::cube     ? "cube"
                       : texture.shape == TextureShape::layers ? "2d-array"
                                                               : "2d";
    Json entry{{"name", texture.name}, {"kind", kind}};
    if (texture.shape == TextureShape::layers) entry["layers"] = view.faces;
    entry["channels"] = texture.layout.channels;
    entry["format"] = format_name(texture.layout.format);
    if (texture.layout.format != texture.texture->format())
        entry["scene_format"] = format_name(texture.texture->format());
    entry["gl"] = {{"internal_format", texture.layout.internal_format},
                   {"format", texture.layout.components},
                   {"type", texture.layout.component_type}};
    entry["dxgi"] = texture.layout.dxgi;
    entry["webgpu"] = texture.layout.webgpu;
    entry["levels"] = levels;
    return entry;
}

Json sampler_entry(const ContentSampler& sampler) {
    const SamplerState& state = sampler.state;
    Json border = Json::array();
    for (const float component : state.border) border.push_back(number(component));
    return {{"uniform", sampler.uniform},
            {"texture", sampler.texture},
            {"wrap", {wrap_name(state.wrap_u), wrap_name(state.wrap_v)}},
            {"mag", filter_name(state.mag)},
            {"min", filter_name(state.min)},
            {"mip", mip_filter_name(state.mip)},
            {"border", border},
            {"lod_bias", number(state.lod_bias)},
            {"lod_min", number(state.lod_min)},
            {"lod_max", number(state.lod_max)}};
}

/// The number behind "#version"; 0 where the language has none.
int version_of(const std::string& shader) {
    const std::string word = "#version ";
    return shader.starts_with(word) ? std::atoi(shader.c_str() + word.size()) : 0;
}

/// What WebGPU's pipelines are made of.
Json webgpu_entry(const ContentMaterial& material, std::size_t passes) {
    Json entries = Json::array(), uniforms = Json::object(), bindings = Json::array();
    for (std::size_t pass = 0; pass < passes; ++pass)
        entries.push_back(fmt::format("pass{}", pass));
    const UniformBuffer buffer = uniform_buffer(material.program.uniforms);
    for (std::size_t i = 0; i < buffer.offsets.size(); ++i)
        uniforms[material.program.uniforms[i].name] = buffer.offsets[i];
    for (const ContentSampler& sampler : material.samplers) {
        const std::string& shader = material.program.fragment;
        const int bound = binding_of(shader, sampler.uniform + "_sampler");
        bindings.push_back({{"texture", binding_of(shader, sampler.uniform)},
                            {"sampler", bound < 0 ? Json() : Json(bound)}});
    }
    return {{"vertex_entry", "main"},
            {"fragment_entries", entries},
            {"uniform_buffer", {{"binding", 0}, {"size", buffer.size}, {"offsets", uniforms}}},
            {"bindings", bindings}};
}

Json material_entry(const ExportContent& content, const ContentMaterial& material) {
    const Material& of = content.scene->materials[material.material];
    Json samplers = Json::array();
    for (const ContentSampler& sampler : material.samplers)
        samplers.push_back(sampler_entry(sampler));
    Json entry{{"name", of.name},
               {"vertex", material.vertex_file(content.language)},
               {"fragment", material.fragment_file(content.language)}};
    if (const int version = version_of(material.program.fragment)) entry["glsl_version"] = version;
    entry["cull"] = cull_name(draws_shell(of) ? shell_cull(of) : of.cull);
    entry["discards"] = material.discards;
    entry["writes_depth"] = material.writes_depth;
    entry["stages"] = material.stages;
    entry["samplers"] = samplers;
    entry["uniforms"] = uniform_entries(content, material.uniforms);
    if (content.language == "wgsl") entry["webgpu"] = webgpu_entry(material, content.passes.size());
    return entry;
}

Json draw_entry(const ExportContent& content, const Draw& draw) {
    const Object& object = content.scene->objects[draw.object];
    std::size_t material = 0;
    while (content.materials[material].material != object.material) ++material;
    return {{"object", object.name},
            {"material", material},
            {"first_index", draw.first_index},
            {"index_count", draw.index_count},
            {"uniforms", uniform_entries(content, object_values_by_name(*content.scene, object))}};
}

Json passes(const ExportContent& content) {
    Json all = Json::array();
    for (const ProgramPass& pass : content.passes) {
        Json targets = Json::array();
        for (int t = 0; t < pass.target_count; ++t) {
            Json clear = Json::array(), names = Json::array();
            for (const ProgramChannel& of : pass.channels[t]) {
                if (of.kind == ProgramChannel::Kind::none) {
                    clear.push_back(0);
                    names.push_back(nullptr);
                    continue;
                }
                const ExportedChannel& channel = channel_of(content.channels, of);
                const bool whole = channel.type == ChannelType::uint32;
                clear.push_back(whole ? Json(channel.clear)
                                      : number(std::bit_cast<float>(channel.clear)));
                names.push_back({{"name", channel.name}, {"type", whole ? "uint" : "float"}});
            }
            targets.push_back({{"clear", clear}, {"channels", names}});
        }
        all.push_back({{"targets", targets}});
    }
    return all;
}

}  // namespace

Json manifest_of(const ExportContent& content) {
    const Scene& scene = *content.scene;
    Json manifest{
        {manifest_key, manifest_format},
        {"quadrel", content.expected_attributes.at("quadrel:version")},
        {"scene",
         {{"file", scene.file.filename().string()},
          {"hash", scene.hash},
          {"overrides", scene.overrides}}},
        {"language", content.language},
        {"size", {scene.width, scene.height}},
        {"samples", scene.samples},
        {"centroid", scene.centroid},
        {"hardware", name_of(scene.hardware)},
        {"derivatives", content.frame.derivatives == DerivativeMode::fine ? "fine" : "coarse"},
        {"conventions", name_of(scene.conventions)},
        {"state", state_of(scene)},
        {"expected", content.has_reference() ? Json("expected.exr") : Json()},
        {"vertex_buffer", vertex_buffer(content.buffers)},
        {"index_buffer", {{"file", "indices.bin"}, {"count", content.buffers.indices.size()}}}};
    for (const char* list : {"textures", "materials"}) manifest[list] = Json::array();
    for (const ContentTexture& texture : content.textures)
        manifest["textures"].push_back(texture_entry(texture, content.has_reference()));
    for (const ContentMaterial& material : content.materials)
        manifest["materials"].push_back(material_entry(content, material));
    manifest["uniforms"] = uniform_entries(content, frame_values_by_name(content.frame));
    manifest["draws"] = Json::array();
    for (const Draw& draw : content.buffers.draws)
        manifest["draws"].push_back(draw_entry(content, draw));
    manifest["passes"] = passes(content);
    return manifest;
}

}  // namespace quadrel
