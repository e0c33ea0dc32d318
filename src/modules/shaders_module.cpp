// Stages as shaders: compiled once, for no instruction set in particular.
#include <string>
#include <vector>

#include "export/stages/plain_scene.hpp"
#include "export/stages/stage_text.hpp"
#include "export/table.hpp"

namespace quadrel {
namespace {

using namespace recorded;

std::string written(const ExportRequest& request, const RecordedStage& stage) {
    const auto dialect = find_dialect(request.language);
    if (dialect == nullptr) throw RecordingError("no such language");
    const ShaderScene scene = plain_scene(request.side, request.lights);
    FunctionText function =
        write_stage(stage, scene, request.params, {}, *dialect,
                    request.uniforms != 0 ? ParametersAs::uniforms : ParametersAs::constants);
    function.text = assumptions(stage, function, request.side) + function.text;
    return whole_file(function, *dialect);
}

bool write(const ExportRequest* request) {
    std::string text;
    bool is_written = false;
    try {
        const RecordedStage* const stage = find_recorded_stage(request->stage);
        text = stage != nullptr ? written(*request, *stage) : "is not a stage that is recorded";
        for (const Refusal& refusal : refusals())
            if (stage == nullptr && refusal.id == std::string_view(request->stage))
                text = refusal.reason;
        is_written = stage != nullptr;
    } catch (const RecordingError& error) {
        text = error.what();
    }
    request->put(request->to, text.c_str());
    return is_written;
}

/// Why a stage cannot be recorded; empty where it can.
std::string refusal_of(const RecordedStage& stage, const ShaderScene& scene) {
    std::vector<std::max_align_t> params(stage.params_size / sizeof(std::max_align_t) + 1);
    stage.make_params(params.data());
    try {
        Graph graph;
        stage.record(graph, scene, params.data());
    } catch (const RecordingError& error) {
        return error.what();
    }
    return {};
}

void list_stages(void (*put)(void* to, const ExportedStage* stage), void* to) {
    const ShaderScene scene = plain_scene(64, 2);
    for (const RecordedStage& stage : all_recorded_stages()) {
        const std::string refusal = refusal_of(stage, scene);
        const ExportedStage row{stage.text->id, stage.text->room,
                                refusal.empty() ? nullptr : refusal.c_str()};
        put(to, &row);
    }
    for (const Refusal& refusal : refusals()) {
        const ExportedStage row{refusal.id, refusal.room, refusal.reason};
        put(to, &row);
    }
}

}  // namespace
}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::ExportTable*
quadrel_export_table() {
    static constexpr const char* languages[] = {"glsl", "glsl-es", "hlsl", "wgsl"};
    static constexpr quadrel::ExportTable table{
        quadrel::export_magic, quadrel::export_abi_version, languages, 4, &quadrel::list_stages,
        &quadrel::write};
    return &table;
}
