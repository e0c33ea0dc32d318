// The planted errors of this room: each is a defective implementation that a property must catch.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    negative_remainder,    ///< repeat by C++'s %, negative for negative indices
    mirror_without_edge,   ///< mirrored_repeat does not repeat the edge texel (period 2n - 2)
    half_texel,            ///< texel centres at whole coordinates
    swapped_weights,       ///< x and y weights exchanged
    next_row_up,           ///< the second row of the footprint is the one before the first
    border_is_edge,        ///< clamp_to_border gives the edge texel
    weight_after_floor,    ///< weight bits rounded after the coordinate was split
    missing_alpha_zero,    ///< a missing alpha reads as 0
    finer_level_only,      ///< linear mip filter does not blend
    smaller_gradient,      ///< rho is the smaller length
    rho_of_each_level,     ///< sizes of another level than 0
    half_up_level,         ///< nearest mip is floor(d + 0.5)
    nan_to_finest,         ///< a NaN gradient gives level 0
    level_of_each_lane,    ///< a quad's level of detail is not lane 0's
    bias_of_lane_0,        ///< nor is a shader's bias that of lane 0
    ties_to_x,             ///< cube face X wins over Y over Z
    corner_of_two,         ///< a cube corner is the mean of its two neighbours
    clamped_edges,         ///< cube footprints stop at the face's edge
    absolute_major,        ///< cube derivative takes |d major| instead of d|major|
    reciprocal_decode,     ///< c * (1 / 255)
    truncating_encode,     ///< floor(255 x)
    half_towards_zero,     ///< float to half truncates
    filter_before_decode,  ///< mips of sRGB codes instead of linear values
    mips_of_rounded,       ///< a level is made from the rounded previous one
    box_drops_nothing,     ///< the box rule covers the last odd texel, too
    odd_row_lost,          ///< the last odd row is neither stored nor averaged
    rows_swapped,          ///< two rows of a level change places
    flip_forgotten,        ///< flip_v has no effect
    marks_of_all_lanes,    ///< texels of lanes that do not ask are marked, too
    error_swallowed,       ///< a truncated file reads as a success
    orientation_ignored,   ///< pixels stay as they are stored
    turns_swapped,         ///< a quarter turn to the left is one to the right
    reads_twice,           ///< a file is read to be hashed, and again to be decoded
    rows_from_the_top,     ///< a bitmap's first row is taken for its top
    columns_packed,        ///< a grey bitmap's columns are a third of themselves (OpenImageIO)
    luminance_of_points,   ///< of channels X Y Z the Y alone
    layer_not_in_key,      ///< the cache gives one layer for another
};

}  // namespace quadrel::test
