#include "cli/explain/explanations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cli/explain/exit_codes.hpp"
#include "cli/explain/explain_key.hpp"
#include "cli/explain/markdown.hpp"
#include "cli/explain/shader_reasons.hpp"
#include "io/document/keys.hpp"
#include "io/document/stage_parameters.hpp"
#include "quadrel/bake/bake.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/presets.hpp"
#include "render/lists/parameter_text.hpp"

namespace quadrel::cli {
namespace {

using Texts = std::vector<std::string>;

std::string value_names(std::span<const Value> values) {
    std::string text;
    for (const Value value : values) text += fmt::format(" {}", info(value).name);
    return text;
}

std::string slot_names(std::span<const TextureSlot> slots) {
    std::string text;
    for (const TextureSlot slot : slots) text += fmt::format(" {}", slot_name(slot));
    return text;
}

std::string stage_text(const StageInfo& stage) {
    std::string text = fmt::format("{}: stage, {}\n  {}\n  source   {}\n", stage.text.id,
                                   stage.text.room, stage.text.summary, stage.text.source);
    if (!stage.not_reproduced.empty())
        text += fmt::format("  not reproduced: {}\n", stage.not_reproduced);
    for (const ParameterText& p : stage.parameters)
        text += fmt::format("  {}\n", parameter_text(p));
    text += fmt::format("  reads   {}\n  stores  {}\n", value_names(stage.inputs),
                        value_names(stage.outputs));
    if (!stage.textures.empty()) text += fmt::format("  looks up{}\n", slot_names(stage.textures));
    if (const auto reason = why_not_a_shader(stage.text.id))
        text += reason->empty()
                    ? fmt::format("  a shader: quadrel export --stage {}\n", stage.text.id)
                    : fmt::format("  not a shader: {}\n", *reason);
    return text;
}

std::string channel_text(const std::string& name, const ChannelInfo& channel) {
    return fmt::format("{}: channel, {}\n  {} ({})\n", name,
                       channel.type == ChannelType::float32 ? "float" : "uint", channel.meaning,
                       channel.unit);
}

void explain_channels(const std::string& word, Texts& texts) {
    if (const ChannelInfo* channel = find_channel(word))
        texts.push_back(channel_text(word, *channel));
    std::string group;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name.starts_with(word + "."))
            group += fmt::format("  {:<22} {} ({})\n", channel.name, channel.meaning, channel.unit);
    if (!group.empty()) texts.push_back(fmt::format("{}: group of channels\n{}", word, group));
}

void explain_parameter(const std::string& word, Texts& texts) {
    const auto place = parameter_place(word);
    if (!place) return;
    std::string lines;
    for (const StageInfo& stage : all_stages())
        for (const ParameterText& p : stage.parameters)
            if (place->name == p.name && (place->room.empty() || place->room == stage.text.room))
                lines += fmt::format("  {:<26} {}\n", stage.text.id, parameter_text(p));
    if (!lines.empty())
        texts.push_back(fmt::format("{}: parameter of stages\n{}", place->name, lines));
}

void explain_preset(const std::string& word, Texts& texts) {
    const Preset* preset = find_preset(word);
    if (preset == nullptr) return;
    std::string text = fmt::format("{}: preset\n  {}\n  map      {}\n  source   {}\n", word,
                                   preset->summary, preset->map, preset->source);
    text += fmt::format("  frame    {}\n  trace    {}", preset->frame, preset->trace);
    for (const auto& [name, value] : preset->parameters)
        text += fmt::format(" {}={}", name, text_of(value));
    texts.push_back(text + "\n");
}

void explain_baked(const std::string& word, Texts& texts) {
    for (const BakeKindInfo& kind : bake_kinds()) {
        if (word != kind.name) continue;
        std::string text = fmt::format("{}: kind of baked map\n  {}\n", word, kind.text);
        for (const BakeParameter& p : kind.parameters)
            text += fmt::format("  {} = {}: {}\n", p.name, p.standard, p.text);
        texts.push_back(text);
    }
}

void explain_code(const std::string& word, Texts& texts) {
    for (const ExitCodeText& row : exit_codes())
        if (word == std::to_string(row.code))
            texts.push_back(fmt::format("{}: exit code\n  {}\n", word, plain_text(row.meaning)));
}

}  // namespace

std::vector<std::string> explanations(const std::string& word) {
    Texts texts = explain_key(word);
    explain_parameter(word, texts);
    explain_channels(word, texts);
    if (const StageInfo* stage = find_stage(word)) texts.push_back(stage_text(*stage));
    explain_preset(word, texts);
    explain_baked(word, texts);
    explain_code(word, texts);
    return texts;
}

std::vector<std::string> explained_names() {
    std::vector<std::string> names;
    for (const SceneKey& row : scene_keys()) names.emplace_back(row.key);
    for (const ChannelInfo& channel : channel_table()) names.push_back(channel.name);
    for (const StageInfo& stage : all_stages()) {
        names.emplace_back(stage.text.id);
        for (const ParameterText& p : stage.parameters) names.emplace_back(p.name);
    }
    for (const Preset& preset : all_presets()) names.push_back(preset.name);
    for (const BakeKindInfo& kind : bake_kinds()) names.emplace_back(kind.name);
    return names;
}

}  // namespace quadrel::cli
