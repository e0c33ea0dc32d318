// The stages of the quad itself; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/differentiate.hpp"
#include "quadrel/quad/interpolate.hpp"
#include "quadrel/quad/level_of_detail.hpp"
#include "quadrel/quad/relief_depth.hpp"
#include "quadrel/quad/stage_list.hpp"

namespace quadrel {

using QuadStages = StageList<Interpolate, Differentiate, LevelOfDetail, DepthConstant, DepthGraded>;

}  // namespace quadrel
