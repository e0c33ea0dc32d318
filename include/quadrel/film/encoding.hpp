// What a file can store of a value, and how far two stored values are apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace quadrel {

/// How a value was written. srgb8: sRGB (IEC 61966-2-1) in 8 bits; unorm8: linear in 8 bits; half:
/// IEEE 754 binary16.
enum class Encoding : std::int32_t { none, half, unorm8, srgb8 };

const char* encoding_name(Encoding encoding);
/// "half", "unorm8" or "srgb8"; "none" too.
std::optional<Encoding> parse_encoding(const std::string& name);

/// The float32 that a reader gets back after `value` was written in this encoding and correctly
/// rounded. 8 bits: the code / 255, where the code is the nearest, on the encoded side for srgb8;
/// values below 0 give 0, above 1 (and +inf) 255; the one tie of unorm8, 0.5, gives 128. half: the
/// nearest, ties to even; 65520 and more give infinity. A NaN stays NaN, though 8 bits cannot hold
/// one: it differs from every code.
float encode(Encoding encoding, float value);

/// The 8-bit code of a value that `encode` gave for unorm8 or srgb8, 0 to 255.
int code_of(float encoded);

/// Returned by the distances where exactly one side is NaN: more than any other distance.
inline constexpr std::uint32_t no_distance = 0xffffffffu;

/// Floats apart on the line of all float32 values, on which -0 and +0 are the same point, the
/// smallest denormal is 1 from 0, and infinity is 1 beyond the largest finite value. Two NaNs are 0
/// apart. Symmetric.
std::uint32_t ulp_distance(float a, float b);

/// The same in units of the encoding: codes for 8 bits, halves for half.
std::uint32_t ulp_distance(Encoding encoding, float a, float b);

}  // namespace quadrel
