// Which channels of a film are shown as one picture.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

struct PreviewGroup {
    std::string name;                  ///< "N" of N.X; empty for R G B
    std::vector<const Plane*> planes;  ///< 1 to 3, in the order of their endings
};

/// R G B; else what belongs to the first channel; else that alone. The film must have a channel.
PreviewGroup preview_group(const Film& film);

/// Whether each pixel of a preview is made of that pixel's values alone.
bool previews_rows(const Film& film);

}  // namespace quadrel
