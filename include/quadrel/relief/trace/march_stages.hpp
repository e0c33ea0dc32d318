// Searches in steps, refined or not; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/contact.hpp"
#include "quadrel/relief/trace/height_outward.hpp"
#include "quadrel/relief/trace/height_outward_published.hpp"
#include "quadrel/relief/trace/interval.hpp"
#include "quadrel/relief/trace/linear.hpp"
#include "quadrel/relief/trace/linear_thesis.hpp"
#include "quadrel/relief/trace/pom.hpp"
#include "quadrel/relief/trace/pom_dxsdk.hpp"
#include "quadrel/relief/trace/rabbid_pom.hpp"
#include "quadrel/relief/trace/rabbid_relief.hpp"
#include "quadrel/relief/trace/relief_binary.hpp"
#include "quadrel/relief/trace/relief_gg3.hpp"
#include "quadrel/relief/trace/secant.hpp"
#include "quadrel/relief/trace/steep.hpp"
#include "quadrel/relief/trace/steep_adaptive.hpp"
#include "quadrel/relief/trace/steep_constant_xy.hpp"
#include "quadrel/relief/trace/steep_maxmip.hpp"
#include "quadrel/relief/trace/steep_mip.hpp"
#include "quadrel/relief/trace/steep_published.hpp"
#include "quadrel/relief/trace/thesis_linear_binary.hpp"
#include "quadrel/relief/trace/thesis_linear_binary_published.hpp"
#include "quadrel/relief/trace/thesis_sphere.hpp"

namespace quadrel {

using MarchStages =
    StageList<Linear, LinearThesis, HeightOutward, HeightOutwardPublished, Steep, SteepPublished,
              SteepConstantXy, SteepConstantXyPublished, SteepAdaptive, SteepAdaptiveRabbid,
              SteepQuality, SteepMipC, SteepMipI, SteepMaxmip, Pom, PomDxsdk, RabbidPom,
              ReliefBinary, ReliefGg3, RabbidRelief, ThesisLinearBinary,
              ThesisLinearBinaryPublished, Secant, Interval, Contact, ThesisSphere>;

}  // namespace quadrel
