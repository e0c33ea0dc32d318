// Linear-light colours and the sRGB transfer function (IEC 61966-2-1).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace quadrel::textures {

/// Linear light of an sRGB-encoded value in [0, 1].
double decode_srgb(double encoded);

/// The 8-bit sRGB code nearest to a linear value, in the encoded domain; clamped to 0..255.
int srgb_code(double linear);

/// The linear colour of 0xRRGGBB in sRGB.
glm::dvec3 srgb(std::uint32_t rgb);

}  // namespace quadrel::textures
