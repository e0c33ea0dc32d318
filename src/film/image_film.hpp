// An image as a film, to be written as EXR.
#pragma once

#include "quadrel/film/film.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel {

/// Channels Y, Y A (`gray`) or as many of R G B A as there are.
Film image_film(const Image& image, bool gray);

}  // namespace quadrel
