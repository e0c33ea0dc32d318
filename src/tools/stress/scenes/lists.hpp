// The scenes that are known to be hard: height maps, views and geometry, texture coordinates,
// parameters, light; and each stage once over a cruel map.
#pragma once

#include <vector>

#include "stress/scenes/scene.hpp"

namespace quadrel::stress {

std::vector<StressScene> listed_scenes();

}  // namespace quadrel::stress
