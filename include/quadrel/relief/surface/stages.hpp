// The list of surface normals; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/surface/bump_blinn.hpp"
#include "quadrel/relief/surface/bump_noise.hpp"
#include "quadrel/relief/surface/bump_noise_published.hpp"
#include "quadrel/relief/surface/h2n_4tap.hpp"
#include "quadrel/relief/surface/h2n_4tap_published.hpp"
#include "quadrel/relief/surface/h2n_gather.hpp"
#include "quadrel/relief/surface/h2n_gather_published.hpp"
#include "quadrel/relief/surface/h2n_impostor.hpp"
#include "quadrel/relief/surface/h2n_layers.hpp"
#include "quadrel/relief/surface/h2n_patch.hpp"
#include "quadrel/relief/surface/h2n_sobel.hpp"
#include "quadrel/relief/surface/h2n_sobel_published.hpp"
#include "quadrel/relief/surface/h2n_thesis.hpp"
#include "quadrel/relief/surface/h2n_thesis_published.hpp"
#include "quadrel/relief/surface/none.hpp"
#include "quadrel/relief/surface/normal_layers.hpp"
#include "quadrel/relief/surface/normal_layers_published.hpp"
#include "quadrel/relief/surface/normal_map.hpp"
#include "quadrel/relief/surface/normal_map_flightgear.hpp"
#include "quadrel/relief/surface/normal_mcguire_published.hpp"
#include "quadrel/relief/surface/normal_smooth_mcguire.hpp"
#include "quadrel/relief/surface/normal_welsh_published.hpp"

namespace quadrel {

using SurfaceStages =
    StageList<SurfaceNone, H2nThesis, H2nThesisPublished, H2nGather, H2nGatherPublished, H2n4Tap,
              H2n4TapPublished, H2nSobel, H2nSobelPublished, H2nPatch, H2nLayers, H2nImpostor,
              BumpBlinn, BumpNoise, BumpNoisePublished, NormalMap, NormalMapFlightGear,
              NormalSmoothMcGuire, NormalMcGuirePublished, NormalWelshPublished, NormalLayers,
              NormalLayersPublished>;

}  // namespace quadrel
