// The sRGB transfer functions (IEC 61966-2-1; Direct3D 11.3 functional specification 3.2.3.7).
// Their exponents are ratios of small integers, so roots by Newton's method serve: no libm, equal
// bits everywhere.
#pragma once

namespace quadrel {

/// Decodes an encoded value in [0, 1]; monotone beyond.
double srgb_to_linear(double encoded);
/// Encodes a linear value in [0, 1].
double linear_to_srgb(double linear);

}  // namespace quadrel
