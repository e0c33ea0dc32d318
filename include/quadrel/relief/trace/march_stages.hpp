// Searches in steps, refined or not; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/linear.hpp"
#include "quadrel/relief/trace/linear_thesis.hpp"

namespace quadrel {

using MarchStages = StageList<Linear, LinearThesis>;

}  // namespace quadrel
