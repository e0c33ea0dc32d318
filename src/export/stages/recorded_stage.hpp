// A stage as a text that can be recorded, type-erased.
#pragma once

#include <cstdint>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrel/num/shader/graph.hpp"
#include "quadrel/quad/shader_io.hpp"
#include "quadrel/quad/stage_list.hpp"

namespace quadrel::recorded {

struct RecordedStage {
    const StageText* text;
    /// Runs the text with `params`, a Params of the stage's. Throws RecordingError.
    void (*record)(Graph& graph, const ShaderScene& scene, const void* params);
    std::vector<std::string> (*inputs)();  ///< in the order of the stage's list
    const ParameterText* parameters;
    std::int32_t parameter_count;
    std::size_t params_size;
    void (*make_params)(void* params);  ///< with the defaults
    bool reads_vertices;                ///< whether it computes at the vertices
};

template <class Stage>
void record_stage(Graph& graph, const ShaderScene& scene, const void* params) {
    const Recorder recorder(graph);
    const ShaderTextures::Use textures(scene.textures);
    StageIo<Stage, Shader> io(scene);
    Stage()(io, *static_cast<const typename Stage::Params*>(params));
}

/// Names of the stage's inputs, those a light of all lights.
template <class Stage>
std::vector<std::string> input_names() {
    std::vector<std::string> names;
    for (const Value value : Stage::inputs) {
        const int lights = info(value).per_light ? max_lights : 1;
        for (int light = 0; light < lights; ++light) {
            if (info(value).components != 6) {
                names.push_back(shader_name(value, light));
                continue;
            }
            names.push_back(shader_name(value, light, "_u"));
            names.push_back(shader_name(value, light, "_v"));
        }
    }
    return names;
}

template <class Stage>
RecordedStage recorded_stage() {
    using Params = typename Stage::Params;
    return {&Stage::text,
            &record_stage<Stage>,
            &input_names<Stage>,
            Stage::parameters.data(),
            static_cast<std::int32_t>(Stage::parameters.size()),
            sizeof(Params),
            [](void* params) { new (params) Params(); },
            Stage::reads_vertices};
}

template <class... Stages>
std::vector<RecordedStage> recorded_stages(StageList<Stages...>) {
    return {recorded_stage<Stages>()...};
}

/// All stages that shaders can be made of, and why others cannot.
struct Refusal {
    const char *id, *room;
    const char* reason;
};
const std::vector<RecordedStage>& all_recorded_stages();
const std::vector<Refusal>& refusals();
/// Null where there is none of that id.
const RecordedStage* find_recorded_stage(std::string_view id);
/// The stage of that id. Throws RecordingError, "ID: why", where there is none.
const RecordedStage& known_recorded_stage(std::string_view id);

}  // namespace quadrel::recorded
