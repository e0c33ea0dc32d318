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
    // Cones.
    ratio_an_ulp_wide,  ///< the next float above each ratio
    ratio_halved,       ///< cones that are sound but needlessly narrow
    square_metric,      ///< distances in units of one axis on both
    open_cones,         ///< the widest ratio everywhere
    sectors_turned,     ///< a sector's ratio in the next one
    first_ratio,        ///< the first ratio everywhere
    no_least_of_3x3,    ///< the filter left out
    code_rounded_up,    ///< the next code above
    early_exit,         ///< one sample fewer below each texel than listed
    ratio_not_root,     ///< a ratio where a map has its root
    exact_distances,    ///< distances to texels where a source has those of rings
    // Searches by blocks.
    block_too_low,           ///< blocks a little lower than their greatest texel
    beyond_forgotten,        ///< nothing beyond the stored grid
    distance_of_the_middle,  ///< a block's middle instead of its nearest texel
    sectors_of_the_middle,   ///< the sectors that a block's middle is in
    // Volumes, horizons, normals, tables.
    raised,          ///< every value a little too high
    lowered,         ///< every value a little too low
    layers_turned,   ///< a layer's values in the next one
    doubled_slopes,  ///< the sums of the source, not divided
    green_flipped,   ///< normals that lean towards falling v
    // Any map.
    threads_in_values,   ///< values that depend on the number of threads
    position_in_values,  ///< values that depend on where the texel lies
    progress_falls,      ///< progress that goes back
};

}  // namespace quadrel::test
