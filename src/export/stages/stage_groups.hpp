// The stages that are recorded, in groups that are compiled beside each other.
#pragma once

#include "export/stages/recorded_stage.hpp"

namespace quadrel::recorded {

std::vector<RecordedStage> search_stages();
std::vector<RecordedStage> shading_stages();
std::vector<RecordedStage> shell_stages();

}  // namespace quadrel::recorded
