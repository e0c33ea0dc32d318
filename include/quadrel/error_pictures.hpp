// Errors (errors.hpp) to look at: each measure on one scale, whatever the film.
#pragma once

#include <string>

#include "quadrel/film/preview.hpp"

namespace quadrel {

/// The magnitude of an err.* channel, `err.color` the largest of its three, as a picture: on a
/// logarithmic scale that is the channel's own, so that pictures can be compared (uv: 1/256 to 64
/// texels); black below, gray NaN. A kind has a colour for each. Throws UsageError where the film
/// has no such channel.
Picture error_picture(const Film& film, const std::string& channel);

/// Pictures of kind and of each measure, with their scales, side by side.
Picture error_sheet(const Film& film);

}  // namespace quadrel
