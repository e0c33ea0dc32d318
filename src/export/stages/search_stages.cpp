// The words come before the rows, whose texts call them.
#include "quadrel/relief/shader_words.hpp"
// The traces.
#include "export/stages/stage_groups.hpp"
#include "quadrel/relief/trace/cone/stages.hpp"
#include "quadrel/relief/trace/curved/stages.hpp"
#include "quadrel/relief/trace/engine/stages.hpp"
#include "quadrel/relief/trace/exact/stages.hpp"
#include "quadrel/relief/trace/layer/stages.hpp"
#include "quadrel/relief/trace/march/stages.hpp"
#include "quadrel/relief/trace/offset/stages.hpp"
#include "quadrel/relief/trace/table/stages.hpp"

namespace quadrel::recorded {

std::vector<RecordedStage> search_stages() {
    std::vector<RecordedStage> all;
    for (const auto& group : {recorded_stages(OffsetStages()), recorded_stages(MarchStages()),
                              recorded_stages(ConeStages()), recorded_stages(ExactStages()),
                              recorded_stages(LayerStages()), recorded_stages(CurvedStages()),
                              recorded_stages(TableStages()), recorded_stages(EngineStages())})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}

}  // namespace quadrel::recorded
