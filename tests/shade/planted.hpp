// The planted errors of this room: each is a defective implementation that a property must catch.
#pragma once

namespace quadrel::test {

enum class Planted {
    none,
    as_published,            ///< the listing's lighting in place of the corrected one
    no_attenuation,          ///< lights do not fade with distance
    linear_as_quadratic,     ///< two attenuation coefficients exchanged
    first_light_only,        ///< further lights have no effect
    highlight_on_dark_side,  ///< the specular term does not ask for N.L > 0
    visibility_ignored,      ///< shadows have no effect
    ambient_shadowed,        ///< shadows darken the ambient term, too
    mirror_before_opacity,   ///< reflection mixed in before the base's opacity
    emission_forgotten,      ///< the material's own emission left out of the colour
    black_total_reflection,  ///< where refract() gives 0 the refraction is black
    environment_turns,       ///< the environment looked up with eye-space vectors
    opacity_of_white,        ///< opacity always 1
    occlusion_ignored,       ///< ambient light everywhere
};

}  // namespace quadrel::test
