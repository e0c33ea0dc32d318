// The list of shading stages; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/shade/texture.hpp"
#include "quadrel/shade/thesis.hpp"
#include "quadrel/shade/thesis_published.hpp"

namespace quadrel {

using ShadeStages = StageList<ShadeTexture, ShadeThesis, ShadeThesisPublished>;

}  // namespace quadrel
