// The planted errors of this room: each is a defective implementation that a property must catch.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    // The stages of the published listing.
    coarse_derivatives,    ///< both rows of a quad take the upper row's difference
    gram_tangents,         ///< the corrected frame in place of the listed one
    swapped_tangents,      ///< B before T in the cross product of the normal
    one_ulp_in_rate,       ///< one component of dUVdSR a single ulp off, in one lane of a batch
    step_not_taken,        ///< the search stops one step early
    point_on_the_polygon,  ///< P not displaced before the light is looked at
    normalised_normal,     ///< N normalised after the difference was added
    corrected_shadow,      ///< heights of the shadow march scaled by the depth
    clamped_diffuse,       ///< no negative light
    colour_in_rgba_order,  ///< .gba of an R G B A texel
    nan_not_flagged,       ///< look-ups at NaN are not told
    steps_from_zero,       ///< the loop counter in place of the number of tests
    // Frames.
    frame_of_the_listing,   ///< dot products with tangents that are not perpendicular
    unsigned_area,          ///< a mirrored UV map loses its sign
    rate_without_angle,     ///< the shift not divided by the depth rate
    back_faces_kept,        ///< the normal of a back face not flipped
    frame_always_valid,     ///< degenerate quads report HIT
    degenerate_unnoticed,   ///< the flag uv_degenerate never set
    rate_along_the_normal,  ///< K of the oblique split over the r of the orthogonal one
    // Depth.
    tile_of_the_u_axis,  ///< a tile's length is 1 / |grad u|
    fade_upside_down,    ///< the angles of the fade not where they should be
    // Searches.
    strict_comparison,     ///< F > 0 in place of F >= 0
    one_sample_late,       ///< the sample after the first one below
    one_sample_early,      ///< the sample before
    seat_forgotten,        ///< the march starts on the polygon, wherever that lies
    steps_counted_once,    ///< the same number of steps in every lane
    nan_is_floor,          ///< a broken map looks like a deep one
    hit_at_nan,            ///< a hit whose s is no number
    ray_nudged,            ///< K and tangents a ten-thousandth off
    off_the_ray,           ///< the hit's UV not that of its s
    half_a_step_late,      ///< behind the sample that hit
    surface_not_reached,   ///< a hit reported above the surface
    fetch_not_counted,     ///< one look-up missing from the sum
    interpolated_squares,  ///< the ratio of cones interpolated where a source has its root
    level_0_look_ups,      ///< no implicit derivatives where a source has texture()
    // Exact searches, and the oracle.
    late_border,          ///< borders between cells lie a hundredth of a cell too far
    leap_without_margin,  ///< nodes left where the ray is above them by any amount
    leap_from_entry,      ///< nodes left where the ray enters above them
    corner_cell_skipped,  ///< both borders crossed at once where they are close
    wrong_wrap,           ///< mirrored maps repeated, repeated ones clamped
    accumulated_borders,  ///< parameters of borders summed up from cell to cell
    grazes_unflagged,     ///< the flag ambiguous never set
    later_root,           ///< the second root of a patch in place of the first
    // Certificates.
    cell_beside,         ///< the cell next to the one that is met
    beyond_the_bound,    ///< s off by twice the bound
    spike_overlooked,    ///< a texel that rises ahead of the hit is not seen
    bound_too_small,     ///< the bound of the guess, not of the root
    unproven_as_proven,  ///< what no arithmetic could settle is called certain
    // Normals.
    slope_upside_down,      ///< bumps look like dents
    relief_without_base,    ///< the smooth-shading difference left out
    unnormalised_sum,       ///< a normal longer or shorter than 1
    gain_of_two,            ///< slopes twice too steep
    axes_exchanged,         ///< u for v
    lattice_does_not_wrap,  ///< noise that does not tile
    noise_around_zero,      ///< heights of both signs
    green_ignored,          ///< the direction of a normal map's y
    texel_not_centred,      ///< c in place of 2 c - 1
    density_forgotten,      ///< gradients in place of unit tangents
    second_look_up_uphill,  ///< smoothed against the gradient
    // Shadows.
    shadow_of_the_mirror,  ///< the march away from the light
    unlit_side_visible,    ///< lights behind the surface shine through
    shadow_acne,           ///< the surface shadows itself
    // Any stage.
    output_missing,       ///< a declared output that is never stored
    undeclared_output,    ///< a value that the stage does not declare is stored
    neighbour_quad_seen,  ///< a value of the next quad of the batch
    rough_result,         ///< a value that is a hundredth off
};

}  // namespace quadrel::test
