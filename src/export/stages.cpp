// The words come before the rows, whose texts call them.
#include "quadrel/relief/shader_words.hpp"
//
#include "export/recorded_stage.hpp"
#include "export/stage_groups.hpp"

namespace quadrel::recorded {

const std::vector<Refusal>& refusals() {
    static const std::vector<Refusal> all = {
        {"interpolate", "the rasterizer's: a shader's inputs are interpolated"},
        {"lod", "the samplers': a shader asks them (textureQueryLod)"},
        {"oracle", "proves its hit by interval and rational arithmetic"},
        {"oracle-bilinear", "proves its hit by interval and rational arithmetic"},
        {"oracle-block", "proves its hit by interval and rational arithmetic"},
        {"oracle-tri-main", "proves its hit by interval and rational arithmetic"},
        {"oracle-tri-anti", "proves its hit by interval and rational arithmetic"},
        {"oracle-tri-min", "proves its hit by interval and rational arithmetic"},
        {"shadow-oracle", "proves its shadow by interval and rational arithmetic"},
        {"ao-oracle", "proves its visibility by interval and rational arithmetic"}};
    return all;
}

const std::vector<RecordedStage>& all_recorded_stages() {
    static const std::vector<RecordedStage> all = [] {
        std::vector<RecordedStage> list;
        for (const auto& group : {shading_stages(), search_stages()})
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

}  // namespace quadrel::recorded
