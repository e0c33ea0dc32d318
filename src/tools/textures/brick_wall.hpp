// The bricks of data/textures as functions of the plane, for maps of any size. One tile is u and v
// from 0 to 1; the wall repeats.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace quadrel::textures {

/// From 0 to 1.
double wall_height(const glm::dvec2& uv);
/// Linear light and opacity.
glm::dvec4 wall_colour(const glm::dvec2& uv);
/// Shininess / 255, relative index of refraction / 2, mirror.
glm::dvec3 wall_gloss(const glm::dvec2& uv);

}  // namespace quadrel::textures
