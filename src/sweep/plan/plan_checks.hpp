// What a plan's parts have to be to one another.
#pragma once

#include "io/document/value.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// Throws InputError, at a place of `root`, the plan as it was read, for two scenes or maps of one
/// name, for pictures and published figures at angles that no view has, and for more than a million
/// runs, a week of the quickest ones.
void check_plan(const Plan& plan, const SceneValue& root);

/// Throws InputError, of the plan, for a scene that cannot be read as the plan changes it.
void check_scenes(const Plan& plan);

}  // namespace quadrel::sweep
