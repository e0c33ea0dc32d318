// Searches in safe steps: distance fields and cones; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/cone/cone_aniso.hpp"
#include "quadrel/relief/trace/cone/cone_dummer_exact.hpp"
#include "quadrel/relief/trace/cone/cone_gg3.hpp"
#include "quadrel/relief/trace/cone/cone_hybrid.hpp"
#include "quadrel/relief/trace/cone/cone_quad.hpp"
#include "quadrel/relief/trace/cone/cone_rabbid.hpp"
#include "quadrel/relief/trace/cone/cone_robust.hpp"
#include "quadrel/relief/trace/cone/cone_robust_exact.hpp"
#include "quadrel/relief/trace/cone/cone_step.hpp"
#include "quadrel/relief/trace/cone/relaxed_cone.hpp"
#include "quadrel/relief/trace/cone/relaxed_cone_exact.hpp"
#include "quadrel/relief/trace/cone/relaxed_cone_published.hpp"
#include "quadrel/relief/trace/cone/sphere_3d.hpp"
#include "quadrel/relief/trace/cone/sphere_3d_published.hpp"

namespace quadrel {

using ConeStages =
    StageList<Sphere3d, Sphere3dPublished, ConeStep, ConeRabbid, ConeRabbidFloat, ConeGg3,
              ConeDummerExact, RelaxedCone, RelaxedConePublished, RelaxedConeExact, ConeRobust,
              ConeRobustExact, ConeQuad, ConeAniso, ConeHybrid>;

}  // namespace quadrel
