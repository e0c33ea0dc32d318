// The list of shadows; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/shadow/march_thesis.hpp"
#include "quadrel/relief/shadow/march_thesis_published.hpp"
#include "quadrel/relief/shadow/none.hpp"

namespace quadrel {

using ShadowStages = StageList<ShadowNone, ShadowMarchThesis, ShadowMarchThesisPublished>;

}  // namespace quadrel
