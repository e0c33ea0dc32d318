// Searches in safe steps: distance fields and cones; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"

namespace quadrel {

using ConeStages = StageList<>;

}  // namespace quadrel
