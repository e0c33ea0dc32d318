// Whether two pictures show the same.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel::peers {

/// The mean of |a - b| over R, G and B of all pixels; NaN where either has one. `rgba`: four floats
/// a pixel, as many as the film has.
double mean_difference(const Film& film, const std::vector<float>& rgba);

/// The mean of |a - b| of a plane's values.
double mean_difference(const Plane& plane, const std::vector<float>& values);

}  // namespace quadrel::peers
