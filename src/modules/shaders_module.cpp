// Stages as shaders: compiled once, for no instruction set in particular.
#include <set>
#include <string>
#include <vector>

#include "export/program/program.hpp"
#include "export/program/vertex_values.hpp"
#include "export/stages/plain_scene.hpp"
#include "export/stages/stage_text.hpp"
#include "export/table.hpp"

namespace quadrel {
namespace {

using namespace recorded;

/// The functions of a request, in their order. `apart`: uniforms that each has to itself.
std::vector<FunctionText> functions_of(const ExportRequest& request, const Dialect& dialect,
                                       ShaderScene& scene, const std::set<std::string>& apart) {
    std::vector<FunctionText> functions;
    for (int i = 0; i < request.stage_count; ++i) {
        const StageUse& use = request.stages[i];
        scene.light = use.light;
        try {
            functions.push_back(write_stage(
                known_recorded_stage(use.id), scene, use.params, {}, dialect, "",
                request.uniforms != 0 ? ParametersAs::uniforms : ParametersAs::constants, apart));
        } catch (const RecordingError& error) {
            throw RecordingError(std::string(use.id) + ": " + error.what());
        }
    }
    return functions;
}

std::string written(const ExportRequest& request) {
    const auto dialect = find_dialect(request.language);
    if (dialect == nullptr) throw RecordingError("no such language");
    const PlainScene plain{request.side, request.lights, request.wrap_u, request.wrap_v,
                           request.seat};
    ShaderScene scene = plain_scene(plain);
    std::vector<FunctionText> functions = functions_of(request, *dialect, scene, {});
    if (const auto apart = differing_uniforms(functions); !apart.empty())
        functions = functions_of(request, *dialect, scene, apart);
    std::string text;
    std::vector<Uniform> uniforms;
    std::vector<std::string> comments;
    for (std::size_t i = 0; i < functions.size(); ++i) {
        const StageUse& use = request.stages[i];
        if (functions[i].vertex) {
            text += (text.empty() ? "" : "\n") + functions[i].vertex->text;
            add_uniforms(uniforms, functions[i].vertex->uniforms);
        }
        text += (text.empty() ? "" : "\n") + functions[i].text;
        add_uniforms(uniforms, functions[i].uniforms);
        for (const std::string& comment :
             assumptions(known_recorded_stage(use.id), functions[i], plain, use.light))
            comments.push_back(comment);
    }
    return whole_file(text, uniforms, *dialect, comments);
}

bool write(const ExportRequest* request) {
    std::string text;
    bool is_written = false;
    try {
        text = written(*request);
        is_written = true;
    } catch (const RecordingError& error) {
        text = error.what();
    }
    request->put(request->to, text.c_str());
    return is_written;
}

bool write_program(const ProgramRequest* request) {
    const auto put = [&](const char* part, const std::string& text) {
        request->put(request->to, part, text.c_str());
    };
    try {
        const ProgramText text = compose_program(*request);
        put("vertex", text.vertex);
        put("fragment", text.fragment);
        for (const Attribute& of : text.attributes)
            put("attribute", std::to_string(components_of(of.type)) + " " + of.name + " " +
                                 std::to_string(of.location));
        for (const Uniform& of : text.numbers)
            put("uniform", of.type + " " + of.name + " " + std::to_string(of.count));
        for (const Uniform& of : text.samplers)
            put("sampler", of.type + " " + of.name + " " + std::to_string(slot_of_map(of.name)));
    } catch (const RecordingError& error) {
        put("refusal", error.what());
        return false;
    }
    return true;
}

bool run_vertices(const VertexRun* run) {
    try {
        put_vertex_values(*run);
    } catch (const RecordingError& error) {
        run->program->put(run->program->to, "refusal", error.what());
        return false;
    }
    return true;
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
    const ShaderScene scene = plain_scene({64, 2});
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
    static constexpr quadrel::ExportTable table{
        quadrel::export_magic, quadrel::export_abi_version, &quadrel::list_stages,
        &quadrel::write,       &quadrel::write_program,     &quadrel::run_vertices};
    return &table;
}
