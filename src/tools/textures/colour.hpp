// Linear-light colours and 8-bit sRGB codes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace quadrel::textures {

/// The 8-bit sRGB code nearest to a linear value, in the encoded domain; clamped to 0..255.
int srgb_code(double linear);

/// Linear light of an 8-bit sRGB code.
double linear_of_code(int code);

/// The linear colour of 0xRRGGBB in sRGB.
glm::dvec3 srgb(std::uint32_t rgb);

}  // namespace quadrel::textures
