// quadrel list: what there is to choose from.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/console.hpp"
#include "cli/plugins.hpp"
#include "cli/verbs.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/presets.hpp"

namespace quadrel::cli {
namespace {

using Json = nlohmann::ordered_json;

void print_table(const Json& json) {
    // Names of scenes are names of files, which may be no UTF-8.
    print_json(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json value_names(std::span<const Value> values) {
    Json names = Json::array();
    for (const Value value : values) names.push_back(std::string(info(value).name));
    return names;
}

Json parameter_json(const ParameterText& parameter) {
    return {{"name", parameter.name},
            {"unit", parameter.unit},
            {"meaning", parameter.meaning},
            {"integer", parameter.integer},
            {"minimum", parameter.minimum},
            {"maximum", parameter.maximum},
            {"default", parameter.default_value}};
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
            {"inputs", value_names(stage.inputs)},
            {"outputs", value_names(stage.outputs)},
            {"textures", textures},
            {"parameters", parameters}};
}

void list_algorithms(bool json) {
    if (json) {
        Json all = Json::array();
        for (const StageInfo& stage : all_stages()) all.push_back(stage_json(stage));
        return print_table(all);
    }
    for (const StageInfo& stage : all_stages()) {
        print(fmt::format("{:<9}{:<26} {}\n", stage.text.room, stage.text.id, stage.text.summary));
        if (!stage.not_reproduced.empty())
            print(fmt::format("{:<11}not reproduced: {}\n", "", stage.not_reproduced));
        for (const ParameterText& p : stage.parameters)
            print(fmt::format("{:<11}{} = {} ({} to {}{}{}): {}\n", "", p.name, p.default_value,
                              p.minimum, p.maximum, *p.unit != '\0' ? " " : "", p.unit, p.meaning));
    }
}

void list_channels(bool json) {
    Json all = Json::array();
    for (const ChannelInfo& channel : channel_table()) {
        const char* type = channel.type == ChannelType::float32 ? "float" : "uint";
        if (json) {
            all.push_back({{"name", channel.name},
                           {"type", type},
                           {"unit", channel.unit},
                           {"meaning", channel.meaning}});
        } else {
            print(fmt::format("{:<22}{:<7}{} ({})\n", channel.name, type, channel.meaning,
                              channel.unit));
        }
    }
    if (json) print_table(all);
}

void list_scenes(bool json) {
    if (json) return print_table(Json(installed_scenes()));
    for (const std::string& scene : installed_scenes()) print(scene + "\n");
}

Json preset_json(const Preset& preset) {
    Json parameters = Json::object();
    for (const auto& [name, value] : preset.parameters) parameters[name] = value;
    return {{"name", preset.name},     {"summary", preset.summary}, {"map", preset.map},
            {"source", preset.source}, {"frame", preset.frame},     {"trace", preset.trace},
            {"parameters", parameters}};
}

void list_presets(bool json) {
    Json all = Json::array();
    for (const Preset& preset : all_presets()) all.push_back(preset_json(preset));
    if (json) return print_table(all);
    for (const Preset& preset : all_presets()) {
        print(fmt::format("{:<22} {}\n", preset.name, preset.summary));
        std::string trace = preset.trace;
        for (const auto& [name, value] : preset.parameters)
            trace += fmt::format(" {}={}", name, value);
        print(fmt::format("{:<24}{}; {}\n", "", preset.frame, trace));
        print(fmt::format("{:<24}{}; {}\n", "", preset.map, preset.source));
    }
}

struct Arguments {
    bool json = false;
    std::vector<std::string> plugins;
};

std::shared_ptr<Arguments> add_kind(CLI::App& list, const char* name, const char* meaning,
                                    void (*run)(bool), Action& action) {
    CLI::App* kind = list.add_subcommand(name, meaning);
    const auto arguments = std::make_shared<Arguments>();
    kind->add_flag("--json", arguments->json, "machine-readable, on standard output");
    kind->callback([=, &action] {
        action = [=] {
            load_plugins(arguments->plugins);
            run(arguments->json);
            return ExitCode::ok;
        };
    });
    return arguments;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
    CLI::App* list = app.add_subcommand("list", "list algorithms, channels, presets or scenes");
    list->require_subcommand(1);
    const auto algorithms =
        add_kind(*list, "algorithms", "every stage with its parameters", list_algorithms, action);
    add_plugin_option(*list->get_subcommand("algorithms"), algorithms->plugins);
    add_kind(*list, "channels", "everything that an image can hold", list_channels, action);
    add_kind(*list, "presets", "what engines ship, as choices of stages", list_presets, action);
    add_kind(*list, "scenes", "the installed scenes", list_scenes, action);
}

}  // namespace quadrel::cli
