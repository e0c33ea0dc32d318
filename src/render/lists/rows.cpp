#include "render/lists/rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/document/stage_parameters.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/presets.hpp"
#include "render/lists/parameter_text.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

Json value_list(std::span<const Value> values) {
    Json names = Json::array();
    for (const Value value : values) names.push_back(std::string(info(value).name));
    return names;
}

Json parameter_json(const ParameterText& parameter) {
    Json names = Json::object();
    for (const ValueName& row : value_names(parameter)) names[row.name] = row.value;
    return {{"name", parameter.name},
            {"unit", parameter.unit},
            {"meaning", parameter.meaning},
            {"integer", parameter.integer},
            {"minimum", parameter.minimum},
            {"maximum", parameter.maximum},
            {"default", parameter.default_value},
            {"names", names}};
}

Json stage_json(const StageInfo& stage) {
    Json textures = Json::array(), numbers = Json::array(), parameters = Json::array();
    for (const TextureSlot slot : stage.textures) textures.push_back(std::string(slot_name(slot)));
    for (const std::string_view number : stage.number_types) numbers.push_back(std::string(number));
    for (const ParameterText& parameter : stage.parameters)
        parameters.push_back(parameter_json(parameter));
    return {{"id", stage.text.id},
            {"kind", stage.text.room},
            {"summary", stage.text.summary},
            {"source", stage.text.source},
            {"not_reproduced", stage.not_reproduced},
            {"number_types", numbers},
            {"inputs", value_list(stage.inputs)},
            {"outputs", value_list(stage.outputs)},
            {"textures", textures},
            {"parameters", parameters}};
}

std::string stage_paragraph(const StageInfo& stage) {
    std::string text =
        fmt::format("{:<11}{:<26} {}\n", stage.text.room, stage.text.id, stage.text.summary);
    if (!stage.not_reproduced.empty())
        text += fmt::format("{:<13}not reproduced: {}\n", "", stage.not_reproduced);
    for (const ParameterText& p : stage.parameters)
        text += fmt::format("{:<13}{}\n", "", parameter_text(p));
    return text;
}

/// Up to the end of the first sentence.
std::string first_sentence(const std::string& text) {
    const std::size_t end = text.find(". ");
    return end == std::string::npos ? text : text.substr(0, end + 1);
}

Json preset_json(const Preset& preset) {
    Json parameters = Json::object();
    for (const auto& [name, value] : preset.parameters) {
        if (value.name())
            parameters[name] = *value.name();
        else
            parameters[name] = *value.number();
    }
    return {{"name", preset.name},     {"summary", preset.summary}, {"map", preset.map},
            {"source", preset.source}, {"frame", preset.frame},     {"trace", preset.trace},
            {"parameters", parameters}};
}

std::string preset_text(const Preset& preset) {
    std::string trace = preset.trace;
    for (const auto& [name, value] : preset.parameters)
        trace += fmt::format(" {}={}", name, text_of(value));
    return fmt::format("{:<22} {}\n{:<24}{}; {}\n{:<24}{}; {}\n", preset.name, preset.summary, "",
                       preset.frame, trace, "", preset.map, preset.source);
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

}  // namespace

ListRows algorithm_rows() {
    ListRows rows;
    for (const StageInfo& stage : all_stages())
        rows.push_back({fmt::format("{} {} {} {}", stage.text.id, stage.text.room,
                                    stage.text.summary, stage.text.source),
                        stage_paragraph(stage), stage_json(stage)});
    return rows;
}

ListRows channel_rows() {
    ListRows rows;
    for (const ChannelInfo& channel : channel_table()) {
        const char* type = channel.type == ChannelType::float32 ? "float" : "uint";
        const std::string text =
            fmt::format("{:<22}{:<7}{} ({})\n", channel.name, type, channel.meaning, channel.unit);
        rows.push_back({text,
                        text,
                        {{"name", channel.name},
                         {"type", type},
                         {"unit", channel.unit},
                         {"meaning", channel.meaning}}});
    }
    return rows;
}

ListRows scene_rows() {
    ListRows rows;
    for (const std::string& name : installed_scenes()) {
        const std::string description = scene_description(name);
        rows.push_back({name + " " + description,
                        fmt::format("{:<37} {}\n", printable(name), first_sentence(description)),
                        {{"name", name}, {"description", description}}});
    }
    return rows;
}

ListRows preset_rows() {
    ListRows rows;
    for (const Preset& preset : all_presets())
        rows.push_back({preset_text(preset), preset_text(preset), preset_json(preset)});
    return rows;
}

bool has_all_words(const ListRow& row, const std::vector<std::string>& wanted) {
    const std::string words = lower_case(row.words);
    return std::ranges::all_of(wanted, [&](const std::string& word) {
        return words.find(lower_case(word)) != std::string::npos;
    });
}

std::string rows_json(const ListRows& rows) {
    Json all = Json::array();
    for (const ListRow& row : rows) all.push_back(row.json);
    // Names of scenes are names of files, which may be no UTF-8.
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace quadrel
