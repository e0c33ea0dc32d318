// Simple polygons into triangles.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace quadrel {

/// Cuts a simple, roughly planar polygon into corners - 2 triangles with its own sense of rotation
/// (ear clipping in the plane of Newell's normal); a convex one becomes the fan around corner 0.
/// Degenerate polygons are cut somehow, never refused. Returns indices into `corners`.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const glm::dvec3> corners);

}  // namespace quadrel
