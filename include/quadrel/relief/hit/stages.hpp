// What becomes of a hit: clipping, place in space, depth; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/hit/displace.hpp"
#include "quadrel/relief/hit/frag_depth.hpp"

namespace quadrel {

using HitStages = StageList<Displace, FragDepth>;

}  // namespace quadrel
