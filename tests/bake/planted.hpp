// The planted errors of this room: each is a defective implementation that a property must catch.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    // Cells.
    first_cell_missing,  ///< a non-periodic axis starts one cell late
    last_cell_missing,   ///< an axis has one cell less
    cell_too_many,       ///< a non-periodic axis stores a cell twice
    mirror_by_one_tile,  ///< a mirrored axis repeats after one tile
    // Pyramids.
    wrap_forgotten,    ///< the field goes on as if clamped
    node_an_ulp_low,   ///< one node just below its cells
    node_an_ulp_high,  ///< one node just above
    child_missing,     ///< the odd last column is not in its parent
    texels_not_cells,  ///< maxima of texels where cells are asked for
    nan_ignored,       ///< a node above a NaN that looks sound
};

}  // namespace quadrel::test
