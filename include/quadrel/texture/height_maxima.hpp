// Bounds over regions of a height map, for searches that leave out what lies above all of it: a
// pyramid of greatest heights for each mip level, and how steep the surface is.
#pragma once

#include "quadrel/texture/view.hpp"

namespace quadrel {

/// The bounds of one mip level, by dual cells (relief/cells.hpp) counted from the first stored one.
/// Infinite where a texel is not finite.
struct LevelMaxima {
    /// Node (i, j) of level 0 is the greatest height that a bilinear look-up can give in 2x2 cells
    /// from (2 i, 2 j) on; those of each further level are twice as large. Raised by what the
    /// filters may round up. One channel.
    TextureView nodes;
    /// Texel (i, j) is the greatest difference of neighbouring texels of cells that are at most two
    /// cells away from the 4x4 cells from (4 i, 4 j) on. One channel, one level.
    TextureView slopes;
    std::int32_t width, height;       ///< of the mip level, in texels
    std::int32_t first_x, first_y;    ///< the first stored cell
    std::int32_t count_x, count_y;    ///< stored cells
    std::int32_t repeat_x, repeat_y;  ///< 1: cell index + count is the same; 0: the outermost go on
};

/// Those of all mip levels that a sampler may read, under its wrap modes.
struct HeightMaxima {
    std::int32_t levels;
    float slack;     ///< by how many texels a look-up may be displaced: rounding of weights
    float rounding;  ///< what a look-up may be off by, in heights
    std::int32_t continuous;  ///< 1: look-ups interpolate with exact weights, so that slopes hold
    LevelMaxima level[max_mip_levels];
};

}  // namespace quadrel
