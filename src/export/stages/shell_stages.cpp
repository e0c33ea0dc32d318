// The words come before the rows, whose texts call them.
#include "quadrel/relief/shader_words.hpp"
#include "quadrel/relief/shell/shader_rows.hpp"
// Shells.
#include "export/stages/stage_groups.hpp"
#include "quadrel/relief/shell/stages.hpp"

namespace quadrel::recorded {

/// All of ShellStages but the judge's.
std::vector<RecordedStage> shell_stages() {
    return recorded_stages(
        StageList<FrameShell, FramePrism, FramePrismPublished, PrismExact, PrismPom, PrismGs,
                  PrismGsPublished, DisplacePrismPublished, ShadowShell, ShadowShellMarch>());
}

}  // namespace quadrel::recorded
