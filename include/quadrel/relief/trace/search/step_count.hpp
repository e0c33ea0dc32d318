// How many steps a march takes: the rules of its sources, as functions of the depth rate r of the
// view ray (N.V: 1 seen from above, 0 grazing) or of its UV shift K.
//
//   McGuire and McGuire 2005   mix(10, 5, r), a real number; later (60, 10)
//   DirectX SDK, ATI 2006      trunc of lerp(50, 8, r)
//   ezEngine                   trunc of lerp(max, max / 4, r)
//   Rabbid76                   trunc of clamp(50 q, 1, 50), q = mix(q0, q1, 1 - z^2)
//   O3DE                       16, 32, 64 or 128 by quality, whatever the angle
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Most steps that a march may be asked for.
inline constexpr int most_steps = 65536;

/// How a real number of steps becomes the number that is marched.
enum class StepRounding : std::int32_t { down, up, none };

template <Number F>
F round_steps(F n, StepRounding rounding) {
    if (rounding == StepRounding::down) return trunc(n);
    return rounding == StepRounding::up ? ceil(n) : n;
}

/// From `grazing` steps at r = 0 to `normal` steps at r = 1, at least 1. (lerp: equal numbers stay
/// what they are, where mix may round them down by one.)
template <Number F>
F steps_by_angle(F r, int grazing, int normal, StepRounding rounding = StepRounding::down) {
    const F n =
        lerp(F(static_cast<Scalar<F>>(grazing)), F(static_cast<Scalar<F>>(normal)), saturate(r));
    return max(round_steps(n, rounding), F(1));
}

/// Rabbid76's quality of a ray that shifts by K a unit of depth: `normal` seen from above,
/// `grazing` along the surface.
template <Number F>
F rabbid_quality(const vec2<F>& K, float normal, float grazing) {
    const F z = normalize(vec3<F>(K.x, K.y, F(-1))).z;
    return mix(F(normal), F(grazing), F(1) - pow(abs(z), F(2)));
}
/// Real; 1 to 50.
template <Number F>
F rabbid_steps(F quality) {
    return clamp(quality * F(50), F(1), F(50));
}

/// Texels of level 0 that the ray crosses along the axis where it crosses most.
template <Number F>
F texels_crossed(const SampledTexture& map, const vec2<F>& K) {
    const vec2<F> texels = TexelSize<F>(map).texels;
    return max(abs(K.x) * texels.x, abs(K.y) * texels.y);
}

}  // namespace quadrel
