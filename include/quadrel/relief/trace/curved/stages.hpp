// Searches of relief over curved surfaces; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/curved/curved_quadric.hpp"
#include "quadrel/relief/trace/curved/curved_quadric_published.hpp"
#include "quadrel/relief/trace/curved/prism_free.hpp"

namespace quadrel {

using CurvedStages = StageList<CurvedQuadric, CurvedQuadricPublished, PrismFree>;

}  // namespace quadrel
