// What draws shells: their frame, what goes with it, and what the judge says; see
// relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/shell/frame_shell.hpp"
#include "quadrel/relief/shell/oracle_none.hpp"
#include "quadrel/relief/shell/prism_exact.hpp"
#include "quadrel/relief/shell/prism_pom.hpp"

namespace quadrel {

using ShellStages = StageList<FrameShell, PrismExact, PrismPom, OracleNone>;

}  // namespace quadrel
