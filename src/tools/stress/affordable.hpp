// How much of a scene can be drawn in a reasonable time: marches of 65536 steps towards every
// light, and exact searches of rays that pass a million tiles, may take hours for all pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel::stress {

/// All that a scene stores on its way, but for exact derivatives and what judges hits.
const std::vector<std::string>& plain_channels();

/// The part of the frame, around its middle, that takes at most so many look-ups to be drawn once
/// with all its steps, and at least a quad; none: all of it. The same on every machine.
std::optional<Window> affordable_window(const Scene& scene, double look_ups);

}  // namespace quadrel::stress
