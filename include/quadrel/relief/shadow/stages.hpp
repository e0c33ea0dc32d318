// The list of shadows; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/shadow/cone.hpp"
#include "quadrel/relief/shadow/exact.hpp"
#include "quadrel/relief/shadow/horizon.hpp"
#include "quadrel/relief/shadow/impostor.hpp"
#include "quadrel/relief/shadow/impostor_exact.hpp"
#include "quadrel/relief/shadow/layers.hpp"
#include "quadrel/relief/shadow/layers_exact.hpp"
#include "quadrel/relief/shadow/march_mcguire.hpp"
#include "quadrel/relief/shadow/march_mcguire_published.hpp"
#include "quadrel/relief/shadow/march_thesis.hpp"
#include "quadrel/relief/shadow/march_thesis_published.hpp"
#include "quadrel/relief/shadow/none.hpp"
#include "quadrel/relief/shadow/relief.hpp"
#include "quadrel/relief/shadow/soft_pom.hpp"
#include "quadrel/relief/shadow/soft_pom_published.hpp"
#include "quadrel/relief/shadow/soft_riccardi.hpp"

namespace quadrel {

using ShadowStages =
    StageList<ShadowNone, ShadowMarchThesis, ShadowMarchThesisPublished, ShadowMarchMcguire,
              ShadowMarchMcguirePublished, ShadowRelief, ShadowSoftPom, ShadowSoftPomPublished,
              ShadowSoftRiccardi, ShadowCone, ShadowExact, Horizon, ShadowLayers, ShadowLayersExact,
              ShadowImpostor, ShadowImpostorExact>;

}  // namespace quadrel
