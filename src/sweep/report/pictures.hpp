// Thumbnails of runs: the picture, and where its hits are off.
#pragma once

#include <string>

#include "quadrel/film/preview.hpp"
#include "sweep/run_error.hpp"

namespace quadrel::sweep {

/// R G B of the film, at most `side` pixels a side: means of linear light.
Picture thumbnail(const Film& film, int side);

/// The worst pixel of each of the thumbnail's, on one scale for all: black up to 0.01 texel, then
/// by the logarithm to 100 texels; late from brown to yellow, early from blue to cyan, on another
/// surface green. Magenta: a hit in place of a miss or the other way round, white: NaN, gray: not
/// judged.
Picture error_thumbnail(const RunError& error, int width, int height, int side);

/// "data:image/png;base64,...".
std::string data_uri(const Picture& picture);

}  // namespace quadrel::sweep
