#include "export/program/stage_calls.hpp"

#include <algorithm>
#include <set>

#include "export/stages/plain_maps.hpp"

namespace quadrel::recorded {
namespace {

/// Their work is a rasterizer's and a sampler's.
bool is_given(const StageUse& use) {
    const std::string id = use.id;
    return id == "interpolate" || id == "lod";
}

bool is_of_light(const StageUse& use) {
    return std::string_view(known_recorded_stage(use.id).text->room) == "shadow";
}

FunctionText function_of(const StageUse& use, ShaderScene& scene, const ValueTypes& wanted,
                         const Dialect& dialect) {
    const RecordedStage& stage = known_recorded_stage(use.id);
    scene.light = light_of(use);
    std::set<std::string> outputs;
    for (const auto& [name, type] : wanted) outputs.insert(name);
    try {
        return write_stage(stage, scene, use.params, outputs, dialect, suffix_of(use));
    } catch (const RecordingError& error) {
        throw RecordingError(std::string(use.id) + ": " + error.what());
    }
}

}  // namespace

ShaderScene scene_of(const ProgramRequest& request) {
    ShaderScene scene(*request.frame);
    scene.material = *request.uniforms;
    for (int i = 0; i < texture_slot_count; ++i)
        if (const SampledTexture* const texture = request.textures[i])
            scene.textures.bind(i, map_name(static_cast<TextureSlot>(i)), texture->view,
                                texture->sampler);
    return scene;
}

std::string suffix_of(const StageUse& use) {
    return is_of_light(use) ? "_light" + std::to_string(use.light) : "";
}

int light_of(const StageUse& use) { return is_of_light(use) ? use.light : 0; }

StageCalls::StageCalls(const StageUse* stages, int count, ShaderScene& scene,
                       const ValueTypes& wanted, const Dialect& dialect)
    : open_(wanted) {
    for (int i = count - 1; i >= 0; --i) {
        if (is_given(stages[i]) || open_.empty()) continue;
        FunctionText function = function_of(stages[i], scene, open_, dialect);
        if (function.outputs.empty()) continue;
        for (const Named& output : function.outputs) open_.erase(output.name);
        for (const Named& input : function.inputs) open_.emplace(input.name, input.type);
        functions_.push_back(std::move(function));
    }
    std::reverse(functions_.begin(), functions_.end());
    for (const FunctionText& function : functions_) add_uniforms(uniforms_, function.uniforms);
}

}  // namespace quadrel::recorded
