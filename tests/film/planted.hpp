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
    srgb_gamma_22,           ///< a plain power of 2.2 instead of the two-part curve
};

}  // namespace quadrel::planted
