// Formulas of the level of detail, to tell which one an implementation is closest to.
#pragma once

#include <string>

#include "rules/probe.hpp"

namespace quadrel::rules {

/// "longer gradient, -0.043 to 0": the formula for rho whose logarithm comes closest to levels, and
/// how far it is off. Pixel i has the gradients (x, y) and (z, w) of asked[i], in texels; levels
/// within [low, high] alone count.
std::string formula_words(const std::vector<std::array<float, 4>>& asked, const Values& levels,
                          std::size_t channel, double low, double high);

/// Whether all levels lie between what OpenGL 4.6, 8.14.1 permits: log2 of the greatest component
/// and of the sum of the greatest of each axis, up to `slack`.
bool within_permitted_levels(const std::vector<std::array<float, 4>>& asked, const Values& levels,
                             std::size_t channel, double low, double high, double slack);

}  // namespace quadrel::rules
