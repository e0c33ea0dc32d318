// The errors that the checks of this room are shown to catch, one switch each.
#pragma once

namespace quadrel::planted {

enum class FilmError {
    hash_ignores_names,      ///< two films that differ in a channel's name hash the same
    hash_ignores_window,     ///< a film moved within its frame hashes the same
    hash_keeps_nan_payload,  ///< equal films with other NaN payloads hash differently
    half_pixels,             ///< values pass through half before they reach the file
    window_shifted,          ///< the data window is written one pixel off
    nan_dropped,             ///< NaN comes back as 0
    resolve_reversed,        ///< samples are added in the reverse of their order
    resolve_farthest,        ///< Z of the farthest sample
    resolve_first_nan,       ///< a NaN in sample 0 hides the distances of the others
    compare_skips_nan,       ///< `a - b > tolerance` is false for NaN: as if it were equal
    compare_reference_only,  ///< channels that only the test image has are overlooked
    compare_signed_error,    ///< negative errors count as small
    compare_zero_signs,      ///< -0 and +0 taken as equal bits
    compare_fraction_nan,    ///< a fraction that may exceed excuses a NaN too
    compare_any_fraction,    ///< any number of pixels may exceed once a fraction is given
    compare_worst_first,     ///< the first ten pixels instead of the worst ten
    compare_group_is_all,    ///< one channel's tolerance holds for every channel
    ulp_raw_bits,            ///< difference of the bit patterns: across zero it is huge
    ulp_flush_denormals,     ///< denormals count as zero
    ulp_of_absolute_values,  ///< the signs are lost: -1 and 1 are 0 apart
    ulp_saturating_int,      ///< distances stop at 2^31 - 1
    ulp_nan_is_zero,         ///< NaN is 0 apart from everything
    ulp_zero_signs,          ///< -0 and +0 are 1 apart
    encode_truncates,        ///< codes are rounded down
    encode_gamma_22,         ///< sRGB taken for a power of 2.2
    encode_nan_is_zero,      ///< a NaN becomes code 0, as on a GPU
    encode_half_truncates,   ///< halves rounded towards zero
    flip_rows_only,          ///< the window stays where it is in the frame
    map_one_by_one,          ///< a swap of two channels gives the same one twice
    blame_last,              ///< the symptom itself is blamed
    blame_other_pixel,       ///< a channel is blamed for what it does in another pixel
    stale_memory,            ///< a damaged chunk shows what lay in memory before
    crop_keeps_rows,         ///< a crop moves its window and keeps the first rows
    by_value_keeps_bits,     ///< an integer is compared by its bits with a float
    heat_one_scale,          ///< counts and colours share a scale
    vectors_in_gray,         ///< a vector shows its first component alone
    chunks_swapped,          ///< the second chunk of a file takes the place of the first
    rows_off_by_band,        ///< a band of rows is written a row late
    legal_nan_passes,        ///< `v < lo` is false for NaN: as if it were permitted
    legal_ends_excluded,     ///< a value at an end of its range fails
    legal_unknown_fails,     ///< the ends are looked at although nothing is known
    legal_wide_passes,       ///< a range says nothing, and what lies in it passes
    legal_wide_excuses,      ///< a value outside of a wide range does not fail
    legal_gaps_pass,         ///< several ranges taken for one
    legal_gap_forgotten,     ///< a value between two ranges taken for one of theirs
    legal_window_shifted,    ///< pixels are matched by their place in the window
    legal_first_ten,         ///< the first ten that fail instead of the worst ten
    srgb_gamma_22,           ///< a plain power of 2.2 instead of the two-part curve
    bits_as_srgb,            ///< codes that carry bits went through a transfer function
    bits_dithered,           ///< they were scaled, and some are one off
    bits_inverted,           ///< they are counted from the other end
};

}  // namespace quadrel::planted
