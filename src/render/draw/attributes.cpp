#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "quadrel/film/channels.hpp"
#include "quadrel/render.hpp"
#include "render/errors/error_plan.hpp"
#include "render/inject/injected_values.hpp"
#include "render/plan/names.hpp"
#include "render/plan/plan.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

nlohmann::ordered_json json_of(const ParameterValue& value) {
    if (value.name()) return *value.name();
    return *value.number();
}

/// Stage ids and the parameters that the scene gives, material by material.
std::string algorithm_text(const Scene& scene) {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (const Material& material : scene.materials) {
        auto& entry = all[material.name];
        for (const PlannedStage& stage : material_stages(scene, material)) {
            const std::string room = stage.info->text.room;
            if (room != "quad" && room != "depth" && room != "oracle" && room != "hit")
                entry[room] = stage.info->text.id;
        }
        for (const StageChoice* choice :
             {&material.frame, &material.trace, &material.clip, &material.frag_depth,
              &material.surface, &material.shadow, &material.occlusion, &material.shade})
            for (const auto& [name, value] : choice->parameters)
                entry["parameters"][choice->key + "." + name] = json_of(value);
        entry["depth"] = material.depth;
        if (material.depth_in_tiles) entry["depth_in_tiles"] = true;
        if (material.fade_from < material.fade_to)
            entry["grazing_fade"] = {material.fade_from, material.fade_to};
        entry["seat"] = material.seat;
    }
    return all.dump();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> render_attributes(const Scene& scene,
                                                                   const RenderOptions& options) {
    const HardwareModel hardware = hardware_model(scene.hardware);
    const DerivativeMode derivatives = scene.derivatives.value_or(hardware.derivatives);
    std::vector<std::pair<std::string, std::string>> all = {
        {"quadrel:version", QUADREL_VERSION},
        {"quadrel:scene", scene.canonical},
        {"quadrel:sceneHash", scene.hash},
        {"quadrel:algorithm", algorithm_text(scene)},
        {"quadrel:conventions", name_of(scene.conventions)},
        {"quadrel:hardware", name_of(scene.hardware)},
        {"quadrel:derivatives", derivatives == DerivativeMode::fine ? "fine" : "coarse"},
        {"quadrel:samples", fmt::format("{}", scene.samples)},
        {"quadrel:number", options.number},
    };
    const std::vector<std::string> channels = expand_channels(options.channels);
    if (std::any_of(channels.begin(), channels.end(), is_error_channel))
        all.emplace_back("quadrel:judges", judges_text(scene));
    if (!options.limits.empty()) all.emplace_back("quadrel:limits", options.limits);
    if (!options.injected.empty())
        all.emplace_back("quadrel:injected", injection_text(options.injected));
    if (options.integral)
        all.emplace_back("quadrel:integral",
                         nlohmann::ordered_json{{"samples", options.integral->samples},
                                                {"error", options.integral->error},
                                                {"replicates", IntegralOptions::replicates}}
                             .dump());
    const std::vector<std::string> plugins = plugin_hashes();
    if (!plugins.empty())
        all.emplace_back("quadrel:plugins", fmt::format("{}", fmt::join(plugins, " ")));
    return all;
}

}  // namespace quadrel
