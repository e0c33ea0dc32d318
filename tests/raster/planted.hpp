// Errors planted into the front end to show that the checks can fail.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    half_away_snapping,       ///< ties round away from zero
    truncating_snapping,      ///< floor instead of nearest
    nan_snaps_to_limit,       ///< NaN is not 0
    inclusive_edges,          ///< samples on any edge are in: shared edges are drawn twice
    exclusive_edges,          ///< samples on any edge are out: holes
    bottom_right_rule,        ///< the other consistent fill rule
    int32_edges,              ///< edge values wrap around at 32 bits
    one_winding_only,         ///< edges not normalised: one winding covers nothing
    facing_without_axes,      ///< front is positive area in all conventions
    slivers_dropped,          ///< small pieces are thrown away
    corner_test_only,         ///< a block without a covered corner is skipped
    perspective_depth,        ///< depth interpolated like a varying
    unclamped_depth,          ///< depth leaves [0, 1]
    later_wins_ties,          ///< at equal depth the later triangle is seen
    nearest_by_order,         ///< no depth test
    regular_sample_grid,      ///< 4x samples on a regular grid
    last_covered_centroid,    ///< the highest covered sample instead of the lowest
    quads_from_bounding_box,  ///< quads start at the triangle's first pixel
    quads_from_tile,          ///< quads start at the tile's corner
    quad_once_per_pixel,      ///< a quad is reported for each of its pixels
    cut_in_winding_order,     ///< clip vertices depend on the direction of the edge
    cut_without_w,            ///< vertices behind the eye are kept
    clip_weights_in_window,   ///< noperspective values take the clip-space weights
    linear_interpolation,     ///< no perspective correction
    planes_from_origin,       ///< float planes anchored at the window's origin
    float_weights,            ///< barycentrics in float32
    weighted_sum,             ///< sum of b_i v_i, so that constants are not kept
    clamped_helpers,          ///< helper lanes do not extrapolate
    unsnapped_attributes,     ///< attributes from unsnapped positions
};

}  // namespace quadrel::test
