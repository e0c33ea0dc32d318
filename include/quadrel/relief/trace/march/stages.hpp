// Searches in steps, refined or not; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/march/contact.hpp"
#include "quadrel/relief/trace/march/height_outward.hpp"
#include "quadrel/relief/trace/march/height_outward_published.hpp"
#include "quadrel/relief/trace/march/interval.hpp"
#include "quadrel/relief/trace/march/linear.hpp"
#include "quadrel/relief/trace/march/linear_thesis.hpp"
#include "quadrel/relief/trace/march/pom.hpp"
#include "quadrel/relief/trace/march/pom_dxsdk.hpp"
#include "quadrel/relief/trace/march/rabbid_pom.hpp"
#include "quadrel/relief/trace/march/rabbid_relief.hpp"
#include "quadrel/relief/trace/march/relief_binary.hpp"
#include "quadrel/relief/trace/march/relief_gg3.hpp"
#include "quadrel/relief/trace/march/secant.hpp"
#include "quadrel/relief/trace/march/steep.hpp"
#include "quadrel/relief/trace/march/steep_adaptive.hpp"
#include "quadrel/relief/trace/march/steep_constant_xy.hpp"
#include "quadrel/relief/trace/march/steep_maxmip.hpp"
#include "quadrel/relief/trace/march/steep_mip.hpp"
#include "quadrel/relief/trace/march/steep_published.hpp"
#include "quadrel/relief/trace/march/thesis_linear_binary.hpp"
#include "quadrel/relief/trace/march/thesis_linear_binary_published.hpp"
#include "quadrel/relief/trace/march/thesis_sphere.hpp"

namespace quadrel {

using MarchStages =
    StageList<Linear, LinearThesis, HeightOutward, HeightOutwardPublished, Steep, SteepPublished,
              SteepConstantXy, SteepConstantXyPublished, SteepAdaptive, SteepAdaptiveRabbid,
              SteepQuality, SteepMipC, SteepMipI, SteepMaxmip, Pom, PomDxsdk, RabbidPom,
              ReliefBinary, ReliefGg3, RabbidRelief, ThesisLinearBinary,
              ThesisLinearBinaryPublished, Secant, Interval, Contact, ThesisSphere>;

}  // namespace quadrel
