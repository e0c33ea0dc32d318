// Traces that shift without a search; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/none.hpp"

namespace quadrel {

using OffsetStages = StageList<TraceNone>;

}  // namespace quadrel
