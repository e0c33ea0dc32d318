// The errors that a specification permits an implementation of float32 arithmetic and of samplers.
// Plain data: it crosses module borders. src/render/ranges has one for each interface.
#pragma once

#include <cstdint>

namespace quadrel {

/// Which scale factors the level of detail may be made of.
enum class LodFreedom : std::int32_t {
    exact,   ///< the sampler's own form
    d3d,     ///< from the longer gradient to the root of the sum of both squares
    vulkan,  ///< max(|m_u|, |m_v|) to sqrt(2) (|m_u| + |m_v|), the greater of x and y
    gl,      ///< the same, or to the sum of the greater of |m_u| and of |m_v| in x and y
};

/// Along which row and column of a quad differences are taken.
enum class DerivativeFreedom : std::int32_t {
    exact,  ///< those of the reference's own mode
    quad,   ///< of the quad either one row and one column, or each lane's own
    each,   ///< any, of each component of each difference by itself
};

/// Errors in units of 2^-23 times the result ("ulp") unless said otherwise. All 0: exact arithmetic
/// on float32 inputs, and functions as the reference defines them.
struct ErrorBudget {
    /// Of + - and *, any direction, relative: 2^-23, or 0. Where it is not 0, a product and a sum
    /// may be fused, and sums and products of more than two terms taken in any order.
    double unit = 0;
    double division = 0, square_root = 0, inverse_root = 0;
    double normalize = 0;             ///< of v's factor, over what dot(v, v) has
    double exp2 = 0, exp2_slope = 0;  ///< 2^x: ulp, and as many more a unit of |x|
    double exp = 0, exp_slope = 0;    ///< e^x, likewise
    double log2 = 0, log = 0;         ///< outside of [1/2, 2]
    double log2_absolute = 0;         ///< inside, absolute
    double sine = 0;        ///< absolute, up to |x| = sine_limit; beyond, or if infinite, anything
    double sine_limit = 0;  ///< 0: the reference's own
    double arctangent = 0;  ///< infinite: anything
    bool flushes_denormals = false;
    DerivativeFreedom derivatives = DerivativeFreedom::exact;

    // Samplers.
    double address = 0;   ///< of a texel coordinate and so of weights, in texels
    double filtered = 0;  ///< of a filtered value, relative to the largest tap
    double lod = 0;       ///< of the level of detail, in levels
    /// Of a decoded texel of sRGB8: as a code, how far from its own; of 0 and 255 nothing.
    double srgb = 0;
    LodFreedom lod_freedom = LodFreedom::exact;

    // Interpolation: what no specification states.
    double plane = 0;       ///< of the values at the vertices, relative to the largest of the three
    double snapping = 0;    ///< of the vertices' places, in pixels along each axis
    double evaluation = 0;  ///< of each lane, relative to the largest value at the vertices
};

}  // namespace quadrel
