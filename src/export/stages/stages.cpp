// The words come before the rows, whose texts call them.
#include "quadrel/relief/shader_words.hpp"
//
#include "export/stages/recorded_stage.hpp"
#include "export/stages/stage_groups.hpp"

namespace quadrel::recorded {

const std::vector<Refusal>& refusals() {
    static constexpr const char* by_proof = "proves what it finds, by intervals and rationals";
    static const std::vector<Refusal> all = {
        {"interpolate", "quad", "the rasterizer's: a shader's inputs are interpolated"},
        {"lod", "quad", "the samplers': a shader asks them (textureQueryLod)"},
        {"oracle", "oracle", by_proof},
        {"oracle-bilinear", "trace", by_proof},
        {"oracle-block", "trace", by_proof},
        {"oracle-tri-main", "trace", by_proof},
        {"oracle-tri-anti", "trace", by_proof},
        {"oracle-tri-min", "trace", by_proof},
        {"shadow-oracle", "shadow", by_proof},
        {"ao-oracle", "occlusion", by_proof},
        {"oracle-none", "oracle", "has nothing to say"}};
    return all;
}

const std::vector<RecordedStage>& all_recorded_stages() {
    static const std::vector<RecordedStage> all = [] {
        std::vector<RecordedStage> list;
        for (const auto& group : {shading_stages(), search_stages(), shell_stages()})
            list.insert(list.end(), group.begin(), group.end());
        return list;
    }();
    return all;
}

const RecordedStage* find_recorded_stage(std::string_view id) {
    for (const RecordedStage& stage : all_recorded_stages())
        if (id == stage.text->id) return &stage;
    return nullptr;
}

const RecordedStage& known_recorded_stage(std::string_view id) {
    if (const RecordedStage* const stage = find_recorded_stage(id)) return *stage;
    for (const Refusal& refusal : refusals())
        if (id == refusal.id) throw RecordingError(std::string(id) + ": " + refusal.reason);
    throw RecordingError(std::string(id) + ": is not one of Quadrel's own stages");
}

}  // namespace quadrel::recorded
