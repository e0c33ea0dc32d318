// Searches of cells and hierarchies, the exact ones among them; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"

namespace quadrel {

using ExactStages = StageList<>;

}  // namespace quadrel
