// Pictures that are stored turned or mirrored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "texture/stored_image.hpp"

namespace quadrel {

/// Turns the pixels so that row 0 is the top and column 0 the left of what is to be seen.
/// `orientation` is that of TIFF 6.0 and Exif 2.3, 1 to 8: where the first stored row and column
/// lie. 1 top and left, 2 top and right, 3 bottom and right, 4 bottom and left; from 5 on rows are
/// stored columns: 5 left and top, 6 right and top, 7 right and bottom, 8 left and bottom.
/// Width and height in `info` are exchanged where rows are columns.
void orient(std::vector<unsigned char>& pixels, QuadrelOiioInfo& info, int orientation);

/// The orientation by the resolution line of a Radiance file ("-Y 2 +X 3"), or nothing if the file
/// is none or has no such line. In "+X 3 -Y 2" the rows that are stored are columns, from the left,
/// each from the top.
std::optional<int> radiance_orientation(const std::string& file);

}  // namespace quadrel
