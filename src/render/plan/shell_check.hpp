// What a shell over a mesh asks of its material.
#pragma once

#include "quadrel/scene/scene.hpp"
#include "render/plan/plan.hpp"

namespace quadrel {

/// Throws an InputError that names the key of what frame-shell cannot do, or of what goes with
/// nothing but frame-shell.
void check_shell(const Scene& scene, const Material& material);

/// Throws one where a plan has the judge's values over a shell: they are of rays through polygons.
void check_judge_of_shell(const Scene& scene, const Material& material, const MaterialPlan& plan);

}  // namespace quadrel
