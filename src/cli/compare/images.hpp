// The two images of compare as they were read.
#pragma once

#include "film/compare/compared_images.hpp"

namespace quadrel::cli {

using Images = ComparedImages;

}  // namespace quadrel::cli
