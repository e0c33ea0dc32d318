// Rounding values to what a format can store.
#pragma once

#include <string_view>
#include <utility>

#include "quadrel/texture/format.hpp"

namespace quadrel {

/// Codes of a normalised format: 255, 65535; 0 for the floating-point ones.
int max_code(TexelFormat format);

/// The formats as scene files, command lines and messages name them.
inline constexpr std::pair<std::string_view, TexelFormat> named_formats[] = {
    {"unorm8", TexelFormat::unorm8},
    {"srgb8", TexelFormat::srgb8},
    {"unorm16", TexelFormat::unorm16},
    {"half", TexelFormat::half},
    {"float", TexelFormat::float32}};

std::string_view format_name(TexelFormat format);

/// The nearest half-precision number, halves to even; overflow gives infinity.
double round_to_half(double x);

/// The code of value / unit * max, rounded half up (Direct3D 11.3 functional specification
/// 3.2.3.6); NaN gives 0.
int encode_unorm(double value, double unit, int max);

/// The sRGB code nearest to a linear value, rounded half up on the encoded side; NaN gives 0. By
/// table: a level of a large texture encodes millions.
int encode_srgb8(double linear);

/// `value` in multiples of `unit`, stored in `format` and decoded. `is_alpha`: linear in srgb8.
float store_and_decode(double value, double unit, TexelFormat format, bool is_alpha);

/// The same of `count` values that lie `step` apart, into floats that lie as far apart.
void store_and_decode(const double* values, float* out, int count, int step, double unit,
                      TexelFormat format, bool is_alpha);

}  // namespace quadrel
