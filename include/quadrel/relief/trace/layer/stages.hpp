// Searches of depth layers; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/layer/dual_depth.hpp"
#include "quadrel/relief/trace/layer/dual_depth_exact.hpp"
#include "quadrel/relief/trace/layer/dual_depth_published.hpp"
#include "quadrel/relief/trace/layer/multilayer.hpp"
#include "quadrel/relief/trace/layer/multilayer_exact.hpp"
#include "quadrel/relief/trace/layer/multilayer_published.hpp"
#include "quadrel/relief/trace/layer/true_impostor.hpp"
#include "quadrel/relief/trace/layer/true_impostor_published.hpp"

namespace quadrel {

using LayerStages =
    StageList<DualDepth, DualDepthPublished, DualDepthExact, Multilayer, MultilayerPublished,
              MultilayerExact, TrueImpostor, TrueImpostorPublished>;

}  // namespace quadrel
