// Rigid and affine transforms, in double.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace quadrel {

glm::dmat4 translation(const glm::dvec3& offset);
glm::dmat4 scaling(const glm::dvec3& factors);
/// Counter-clockwise by `degrees` seen from the tip of `axis` (any length but 0) in a right-handed
/// space. Multiples of 90 degrees about a coordinate axis are exact.
glm::dmat4 rotation(double degrees, const glm::dvec3& axis);

}  // namespace quadrel
