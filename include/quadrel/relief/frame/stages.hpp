// The list of frames; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/frame/gram.hpp"
#include "quadrel/relief/frame/none.hpp"
#include "quadrel/relief/frame/thesis.hpp"

namespace quadrel {

using FrameStages = StageList<FrameNone, FrameThesis, FrameGram>;

}  // namespace quadrel
