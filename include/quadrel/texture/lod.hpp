// Level of detail: from screen-space gradients to a mip level. Sources: Vulkan specification,
// "Level-of-Detail Operation" and "Image Level(s) Selection"; Direct3D 11.3 functional
// specification 7.18.10 and 7.18.11.
#pragma once

#include <concepts>

#include "quadrel/num/math.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// Everything that level selection went through.
template <Number F>
struct LodRecord {
    F rho;              ///< texels of level 0 that a pixel spans; 0 where the level was given
    F lambda;           ///< log2(rho) plus bias, before any clamp
    F level;            ///< clamped to [0, levels - 1]; an integer with MipFilter::nearest
    F frac;             ///< weight of level + 1
    Mask<F> magnified;  ///< the magnification filter applies
};

/// Bias of sampler and shader together is clamped to this (VkPhysicalDeviceLimits, Direct3D).
inline constexpr float max_lod_bias = 16.0f;

/// e + (m - 1) for x = m * 2^e, 1 <= m < 2: log2 with a linear mantissa, at most 0.0861 low.
/// x must be positive and normal; 0 gives about -127.
template <Number F>
F linear_log2(F x) {
    return select(is_nan(x), x, exponent(x) + (significand(x) - F(1)));
}

/// The bits of x, read as an integer and rounded to a float: linear_log2 with the rounding that
/// the packed conversion brings.
template <Number F>
F packed_log2(F x) {
    if constexpr (std::same_as<Scalar<F>, float>) {
        const F bits = to_float<F>(as_int(x));
        return select(is_nan(x), x, (bits - F(1065353216.0f)) * F(1.0f / 8388608.0f));
    } else {
        return linear_log2(x);
    }
}

/// Square of the larger gradient length; dx and dy in texels.
template <Number F>
F largest_square(const vec2<F>& dx, const vec2<F>& dy) {
    return max(dot(dx, dx), dot(dy, dy));
}

/// Half the major axis of the ellipse that the unit circle of the screen becomes, by the larger
/// eigenvalue of its quadratic form (P. Heckbert, "Fundamentals of Texture Mapping and Image
/// Warping", 1989). Where the gradients are parallel or null there is no ellipse: the larger
/// length.
template <Number F>
F ellipse_major_axis(const vec2<F>& dx, const vec2<F>& dy) {
    const F a = dx.x * dx.x + dy.x * dy.x;
    const F b = dx.y * dx.y + dy.y * dy.y;
    const F c = dx.x * dx.y + dy.x * dy.y;
    const F half_difference = (a - b) * F(0.5f);
    const F major = sqrt((a + b) * F(0.5f) + sqrt(half_difference * half_difference + c * c));
    const F area = dx.x * dy.y - dx.y * dy.x;
    return select(area == F(0), sqrt(largest_square(dx, dy)), major);
}

/// rho and log2(rho), by the sampler's form, of gradients in texels of level 0.
template <Number F>
struct ScaleFactor {
    F rho, log2_rho;
};

template <Number F>
ScaleFactor<F> scale_factor(LodForm form, const vec2<F>& dx, const vec2<F>& dy) {
    if (form == LodForm::ellipse) {
        const F rho = ellipse_major_axis(dx, dy);
        return {rho, log2(rho)};
    }
    const F square = largest_square(dx, dy);
    const F rho = sqrt(square);  // the larger of both roots: sqrt is monotonic, rounded as well
    if (form == LodForm::linear_log2) return {rho, linear_log2(square) * F(0.5f)};
    if (form == LodForm::quartic_log2) return {rho, packed_log2(square * square) * F(0.25f)};
    return {rho, log2(rho)};
}

/// max(low, min(high, x)): low wins, and NaN (a broken gradient) becomes high, the coarsest level,
/// as an infinite gradient does.
template <Number F>
F clamp_lod(F x, float low, float high) {
    const F below = select(x < F(high), x, F(high));
    return select(below > F(low), below, F(low));
}

/// x rounded to `bits` fraction bits, halves to even; 0 bits: exact.
template <Number F>
F round_lod(F x, std::int32_t bits) {
    if (bits == 0) return x;
    const float scale = static_cast<float>(1 << bits);
    return round_even(x * F(scale)) * F(1 / scale);
}

/// The level that is nearest to d.
template <Number F>
F nearest_level(F d, LevelRounding rounding) {
    return rounding == LevelRounding::even ? round_even(d) : ceil(d + F(0.5f)) - F(1);
}

/// Fills level, frac and magnified of a record whose lambda is known.
template <Number F>
LodRecord<F> select_level(const SampledTexture& texture, F rho, F lambda) {
    const SamplerState& s = texture.sampler;
    const F clamped = round_lod(clamp_lod(lambda, s.lod_min, s.lod_max), s.lod_bits);
    const Mask<F> magnified = clamped <= F(0);
    if (s.mip == MipFilter::none) return {rho, lambda, F(0), F(0), magnified};
    const F d = clamp_lod(clamped, 0, static_cast<float>(texture.view.levels - 1));
    if (s.mip == MipFilter::nearest)
        return {rho, lambda, nearest_level(d, s.level_rounding), F(0), magnified};
    return {rho, lambda, d, d - floor(d), magnified};
}

/// The record of a given level of detail; the sampler's bias is added, as for textureLod.
template <Number F>
LodRecord<F> lod_from_level(const SampledTexture& texture, F lod) {
    const F bias = clamp(F(texture.sampler.lod_bias), F(-max_lod_bias), F(max_lod_bias));
    return select_level(texture, F(0), lod + bias);
}

/// Screen-space gradients.
template <Number F>
struct Gradients {
    vec2<F> x, y;
};

/// In texels of level 0, of those in units of the texture.
template <Number F>
Gradients<F> texel_gradients(const SampledTexture& texture, const Gradients<F>& of) {
    const F width(static_cast<float>(texture.view.width[0]));
    const F height(static_cast<float>(texture.view.height[0]));
    return {{of.x.x * width, of.x.y * height}, {of.y.x * width, of.y.y * height}};
}

/// The sampler's bias and the shader's.
template <Number F>
F total_bias(const SampledTexture& texture, F bias) {
    return clamp(F(texture.sampler.lod_bias) + bias, F(-max_lod_bias), F(max_lod_bias));
}

/// rho and log2(rho) of screen-space gradients of uv (per pixel, in units of the texture).
template <Number F>
ScaleFactor<F> scale_factor_of(const SampledTexture& texture, const vec2<F>& dx,
                               const vec2<F>& dy) {
    const Gradients<F> texels = texel_gradients<F>(texture, {dx, dy});
    return scale_factor(texture.sampler.lod_form, texels.x, texels.y);
}

/// The record of a scale factor, with the sampler's and the shader's bias.
template <Number F>
LodRecord<F> lod_of_scale(const SampledTexture& texture, const ScaleFactor<F>& scale,
                          F bias = F(0)) {
    return select_level(texture, scale.rho, scale.log2_rho + total_bias(texture, bias));
}

/// Whether a look-up depends on the level of detail: by the level that it reads, or by the filter.
inline bool lod_matters(const SampledTexture& texture) {
    const SamplerState& s = texture.sampler;
    return s.mag != s.min || (s.mip != MipFilter::none && texture.view.levels > 1);
}

/// Who asks for a record: one who shows it, or a look-up, for which rho and lambda may be anything.
enum class LodUse { shown, look_up };

/// The record of look-ups at level 0, magnified.
template <Number F>
LodRecord<F> finest_lod() {
    return {F(0), F(0), F(0), F(0), Mask<F>(true)};
}

/// Whether level 0 is read, magnified, in every lane, as is plain before a logarithm is taken.
template <Number F>
bool all_magnified(const SampledTexture& texture, const Gradients<F>& texels, F total) {
    const SamplerState& s = texture.sampler;
    return s.lod_form != LodForm::ellipse && s.lod_min <= 0 &&
           all((largest_square(texels.x, texels.y) <= F(1)) & (total <= F(0)));
}

/// compute_lod for whoever asks.
template <Number F>
LodRecord<F> lod_for(LodUse use, const SampledTexture& texture, const vec2<F>& dx,
                     const vec2<F>& dy, F bias = F(0)) {
    if (use == LodUse::look_up && !lod_matters(texture)) return finest_lod<F>();
    const Gradients<F> texels = texel_gradients<F>(texture, {dx, dy});
    if (use == LodUse::look_up && all_magnified(texture, texels, total_bias(texture, bias)))
        return finest_lod<F>();
    return lod_of_scale(texture, scale_factor(texture.sampler.lod_form, texels.x, texels.y), bias);
}

/// The record of screen-space gradients of uv, with the shader's bias.
template <Number F>
LodRecord<F> compute_lod(const SampledTexture& texture, const vec2<F>& dx, const vec2<F>& dy,
                         F bias = F(0)) {
    return lod_of_scale(texture, scale_factor_of(texture, dx, dy), bias);
}

}  // namespace quadrel
