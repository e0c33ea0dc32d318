// Errors planted into the quad stages and the registry to show that the checks can fail.
#pragma once

namespace quadrel::quad_tests {

enum class Planted {
    none,
    // derivatives
    left_minus_right,  ///< dFdx of the wrong sign
    rows_for_columns,  ///< dFdy is dFdx
    coarse_for_fine,   ///< one difference for the whole quad
    odd_row_coarse,    ///< the coarse difference of the odd row
    width_of_sum,      ///< fwidth = |dFdx + dFdy|
    // interpolation
    linear_interpolation,  ///< no perspective correction
    clamped_helpers,       ///< helper lanes do not extrapolate
    first_primitive,       ///< one primitive for a whole packet
    // level of detail
    colour_map_first,  ///< of the colour map although there is a height map
    // registry
    equal_ids,              ///< two stages of one id
    default_out_of_range,   ///< a default that the range forbids
    other_default,          ///< a described default that is not the struct's
    fraction_for_count,     ///< an integer parameter with a fraction for a default
    set_does_nothing,       ///< `set` writes nowhere
    unproduced_input,       ///< a stage loads what nothing stores
    produced_too_late,      ///< a stage loads what a later one stores
    alternative_lacks_one,  ///< a frame that does not store what traces load
    unnamed_source,         ///< a stage without source
    missing_kernel,         ///< a stage without a row in the kernel table
};

}  // namespace quadrel::quad_tests
