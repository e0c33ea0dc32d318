// The list of surface normals; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/surface/h2n_thesis.hpp"
#include "quadrel/relief/surface/h2n_thesis_published.hpp"
#include "quadrel/relief/surface/none.hpp"

namespace quadrel {

using SurfaceStages = StageList<SurfaceNone, H2nThesis, H2nThesisPublished>;

}  // namespace quadrel
