// Random scenes, from tame to absurd.
#pragma once

#include <cstdint>

#include "stress/scenes/scene.hpp"

namespace quadrel::stress {

/// Scene `number` of a seed, the same on every machine. How absurd it is, is a part of the draw.
StressScene random_scene(std::uint64_t seed, std::uint64_t number);

}  // namespace quadrel::stress
