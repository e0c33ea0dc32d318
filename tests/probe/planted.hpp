// Errors planted to see the checks of this folder catch them.
#pragma once

namespace quadrel::planted {

enum class Probe {
    neighbour_lane,  ///< values of the next lane of the quad
    other_row,       ///< image y taken for window y where they differ
    one_bit,         ///< a value off by its last bit
};

}  // namespace quadrel::planted
