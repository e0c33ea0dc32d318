// Messages of the viewer tev's network protocol, as its own sources (Ipc,
// https://github.com/Tom94/tev) assemble them: little-endian; the length of the whole in front;
// texts end with a zero.
#pragma once

#include <string>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// CreateImage: an image of the film's window and channels, in the place of one of that name.
std::string tev_create_image(const std::string& name, const Film& layout);

/// UpdateImageV3: pixels of `part`, which lies in the window of `film`; `whole` is the window that
/// the image was created for. All values are floats: integers become the nearest.
std::string tev_update_image(const std::string& name, const Film& film, const Window& part,
                             const Window& whole);

}  // namespace quadrel
