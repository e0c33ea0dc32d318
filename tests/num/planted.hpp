// Defects that the tests of this room must catch; each is planted in a test of its own.
#pragma once

namespace quadrel::num_tests {

enum class Planted {
    // Same bits (same_bits_test.cpp)
    fused_multiply_add,     // dot rounds once where the text rounds twice
    dot_right_to_left,      // the sum of dot is added from the last term
    reciprocal_division,    // a / b as a * (1 / b)
    denormals_flushed,      // products below the normal range become 0
    min_as_minps,           // min(NaN, b) gives b, as the x86 instruction does
    to_int_as_cvttps,       // to_int of NaN and of large numbers gives INT_MIN
    round_half_away,        // round_even rounds halves away from zero
    arithmetic_shift_lost,  // shift_right fills with zeros
    columns_swapped,        // dFdx takes left minus right
    changed_constant,       // one constant of a text differs by an ulp: only hashes see it
    // Errors in ulps (ulp_test.cpp)
    double_in_float,     // a double function computed in float
    single_word_pow,     // pow without double words
    one_word_reduction,  // sin with pi / 2 as one word
    short_polynomial,    // exp2 from a polynomial of too low a degree
    // Special values (special_values_test.cpp)
    sine_drops_sign_of_zero,   // sin(-0) = +0
    sine_escapes,              // sin of a huge argument is outside [-1, 1]
    zero_to_zero_is_nan,       // pow(0, 0) = NaN
    power_of_negative,         // pow(-2, 2) = 4
    denormal_logarithm,        // log2 of a denormal as if it were 0
    exp2_overflows_early,      // exp2 gives infinity from 127 on
    atan2_ignores_minus_zero,  // atan2(0, -0) = 0
    // Conversions (half_test.cpp, srgb_test.cpp)
    half_rounds_up,        // ties away from even
    half_drops_denormals,  // denormal halves become 0
    srgb_without_toe,      // the power curve everywhere
    srgb_gamma_22,         // x^2.2
    // Built-ins (functions_test.cpp)
    normalize_without_root,     // v / dot(v, v)
    inverse_without_transpose,  // the matrix of cofactors as it is
    mix_swapped,                // mix(b, a, t)
    refract_without_root,       // sqrt(k) left out
    // Loops (loop_test.cpp)
    last_step_left_out,  // first, ..., last - 1
    empty_range_walked,  // one step where last < first
    last_int_wraps,      // last + 1 in 32 bits: no step up to the last int
    rounds_end,          // after a thousand
    number_by_float,     // a double's number through float
    when_all_lanes,      // when(mask) asks for every lane
    // What is built of the sources (no_libm_test.cpp, exported_symbols_test.cpp)
    libm_call,
    libm_symbol,
    leaked_symbol,
};

}  // namespace quadrel::num_tests
