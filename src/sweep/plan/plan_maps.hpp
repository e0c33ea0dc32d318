// The height maps of a plan.
#pragma once

#include "io/document/value.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// Appends the maps that an entry of the plan stands for. Throws InputError.
void read_map(const SceneValue& value, std::vector<PlannedMap>& maps);

}  // namespace quadrel::sweep
