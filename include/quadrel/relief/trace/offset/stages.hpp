// Traces that shift without a search; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/offset/none.hpp"
#include "quadrel/relief/trace/offset/offset_limit.hpp"
#include "quadrel/relief/trace/offset/offset_limit_042.hpp"
#include "quadrel/relief/trace/offset/offset_limit_042_published.hpp"
#include "quadrel/relief/trace/offset/offset_limit_fixed.hpp"
#include "quadrel/relief/trace/offset/offset_limit_rabbid.hpp"
#include "quadrel/relief/trace/offset/parallax.hpp"
#include "quadrel/relief/trace/offset/parallax_bias.hpp"
#include "quadrel/relief/trace/offset/parallax_bias_published.hpp"
#include "quadrel/relief/trace/offset/parallax_iter.hpp"
#include "quadrel/relief/trace/offset/parallax_slope.hpp"

namespace quadrel {

using OffsetStages =
    StageList<TraceNone, Parallax, ParallaxBias, ParallaxBiasPublished, OffsetLimit,
              OffsetLimitPublished, OffsetLimit042, OffsetLimit042Published, OffsetLimitFixed,
              OffsetLimitRabbidPublished, ParallaxSlopeNz, ParallaxSlopeNv, ParallaxIter>;

}  // namespace quadrel
