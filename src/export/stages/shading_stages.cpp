// The words come before the rows, whose texts call them.
#include "quadrel/relief/shader_words.hpp"
// Everything before and after the traces.
#include "export/stages/stage_groups.hpp"
#include "quadrel/quad/differentiate.hpp"
#include "quadrel/quad/relief_depth.hpp"
#include "quadrel/relief/frame/stages.hpp"
#include "quadrel/relief/hit/stages.hpp"
#include "quadrel/relief/occlusion/stages.hpp"
#include "quadrel/relief/shadow/stages.hpp"
#include "quadrel/relief/surface/stages.hpp"
#include "quadrel/shade/stages.hpp"

namespace quadrel::recorded {

std::vector<RecordedStage> shading_stages() {
    std::vector<RecordedStage> all;
    using Before = StageList<Differentiate, DepthConstant, DepthGraded>;
    for (const auto& group :
         {recorded_stages(Before()), recorded_stages(FrameStages()), recorded_stages(HitStages()),
          recorded_stages(SurfaceStages()), recorded_stages(ShadowStages()),
          recorded_stages(OcclusionStages()), recorded_stages(ShadeStages())})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}

}  // namespace quadrel::recorded
