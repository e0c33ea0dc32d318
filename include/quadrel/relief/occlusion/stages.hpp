// The list of ambient occlusion; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/occlusion/horizon.hpp"
#include "quadrel/relief/occlusion/none.hpp"

namespace quadrel {

using OcclusionStages = StageList<OcclusionNone, AoHorizon>;

}  // namespace quadrel
