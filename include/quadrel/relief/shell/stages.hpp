// What draws shells: their frame, and the searches that go with it; see relief/stages.hpp.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/shell/frame_shell.hpp"
#include "quadrel/relief/shell/prism_exact.hpp"
#include "quadrel/relief/shell/prism_pom.hpp"

namespace quadrel {

using ShellStages = StageList<FrameShell, PrismExact, PrismPom>;

}  // namespace quadrel
