// Tables that hold what a search would find; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/table/gdm.hpp"
#include "quadrel/relief/trace/table/prewarp.hpp"
#include "quadrel/relief/trace/table/vdm.hpp"

namespace quadrel {

using TableStages = StageList<Gdm, Vdm, ReliefPrewarp>;

}  // namespace quadrel
