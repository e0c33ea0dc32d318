// Searches of cells and hierarchies, the exact ones among them; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/cone_cell.hpp"
#include "quadrel/relief/trace/max_mip.hpp"
#include "quadrel/relief/trace/pyramid.hpp"
#include "quadrel/relief/trace/qdm.hpp"
#include "quadrel/relief/trace/qdm_published.hpp"
#include "quadrel/relief/trace/rmq_leap.hpp"
#include "quadrel/relief/trace/texel_exact.hpp"

namespace quadrel {

using ExactStages = StageList<TexelExact, MaxMip, ConeCell, RmqLeap, Qdm, QdmPublished, Pyramid>;

}  // namespace quadrel
