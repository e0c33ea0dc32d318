// A stroke font: the letters of one word as polylines in a cell one unit wide and one high, y down.
#pragma once

#include <span>
#include <vector>

#include "shaping.hpp"

namespace quadrel::textures {

using Stroke = std::vector<glm::dvec2>;

/// The strokes of a capital letter; none for a letter that the font lacks.
std::span<const Stroke> strokes_of(char letter);

/// Distance from p to the nearest stroke of the letter, in a cell of `size`; large if it has none.
double distance_to_letter(char letter, glm::dvec2 p, glm::dvec2 size);

}  // namespace quadrel::textures
