// The searches of engines, as their shaders have them; see relief/stages.hpp. Presets
// (scene/presets.hpp) name their settings.
#pragma once

#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/trace/unreal_bump_offset.hpp"

namespace quadrel {

using EngineStages = StageList<UnrealBumpOffset>;

}  // namespace quadrel
