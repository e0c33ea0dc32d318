// Errors that a run must find: without them nobody knows whether it can.
#pragma once

#include <vector>

#include "quadrel/film/film.hpp"
#include "stress/scenes/scene.hpp"

namespace quadrel::stress {

/// One scene for each kind of error; StressScene::planted is the kind of finding that it must give.
std::vector<StressScene> planted_scenes();

/// Before anything is drawn: crashes, fails a check or hangs, if that is planted.
void plant_fault(const StressScene& scene);

/// Into what was drawn, by plain numbers and by lanes.
void plant_error(const StressScene& scene, Film& single, Film& lanes);

}  // namespace quadrel::stress
