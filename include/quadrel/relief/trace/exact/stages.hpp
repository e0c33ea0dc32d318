// Searches of cells and hierarchies, the exact ones among them; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/exact/cone_cell.hpp"
#include "quadrel/relief/trace/exact/ddm.hpp"
#include "quadrel/relief/trace/exact/max_mip.hpp"
#include "quadrel/relief/trace/exact/pyramid.hpp"
#include "quadrel/relief/trace/exact/qdm.hpp"
#include "quadrel/relief/trace/exact/qdm_published.hpp"
#include "quadrel/relief/trace/exact/rmq_leap.hpp"
#include "quadrel/relief/trace/exact/texel_exact.hpp"

namespace quadrel {

using ExactStages =
    StageList<TexelExact, MaxMip, ConeCell, RmqLeap, Ddm, Qdm, QdmPublished, Pyramid>;

}  // namespace quadrel
