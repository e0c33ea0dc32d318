// What draws shells: their frames, what goes with them, and what the judge says; see
// relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/shell/displace_prism_published.hpp"
#include "quadrel/relief/shell/frame_prism.hpp"
#include "quadrel/relief/shell/frame_prism_published.hpp"
#include "quadrel/relief/shell/frame_shell.hpp"
#include "quadrel/relief/shell/oracle_none.hpp"
#include "quadrel/relief/shell/prism_exact.hpp"
#include "quadrel/relief/shell/prism_gs.hpp"
#include "quadrel/relief/shell/prism_gs_published.hpp"
#include "quadrel/relief/shell/prism_pom.hpp"
#include "quadrel/relief/shell/shadow_shell.hpp"
#include "quadrel/relief/shell/shadow_shell_march.hpp"

namespace quadrel {

using ShellStages =
    StageList<FrameShell, FramePrism, FramePrismPublished, PrismExact, PrismPom, PrismGs,
              PrismGsPublished, DisplacePrismPublished, ShadowShell, ShadowShellMarch, OracleNone>;

}  // namespace quadrel
