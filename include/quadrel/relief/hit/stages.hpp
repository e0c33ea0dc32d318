// What becomes of a hit: clipping, place in space, depth; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/hit/clip_path.hpp"
#include "quadrel/relief/hit/clip_uv.hpp"
#include "quadrel/relief/hit/displace.hpp"
#include "quadrel/relief/hit/frag_depth.hpp"
#include "quadrel/relief/hit/frag_depth_published.hpp"

namespace quadrel {

using HitStages = StageList<ClipUv, ClipPath, Displace, FragDepth, FragDepthPublished>;

}  // namespace quadrel
