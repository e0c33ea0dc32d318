// Header attributes of an EXR file as text.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include "quadrel/film/exr.hpp"

namespace quadrel {

/// Every attribute except those that say how the pixels are stored. Strings as they are, numbers
/// so that they read back exactly, other types as "<type name>".
Attributes read_attributes(const Imf::Header& header);

}  // namespace quadrel
