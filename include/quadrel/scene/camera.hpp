// View and projection matrices, computed in double and rounded once to float32.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "quadrel/scene/settings.hpp"

namespace quadrel {

/// What a lens sees besides its opening.
struct DepthAndShift {
    double near = 0.1, far = 1000;  ///< distances along the view axis; `far` may be infinity
    bool reversed_z = false;        ///< near maps to the end of the depth range, far to its start
    glm::dvec2 shift{0, 0};         ///< moves the image, in NDC: 1 is half the picture; +y is up
};

/// World to eye space: the eye at the origin looks down -z, x to the right, y up.
/// Precondition: eye differs from target and `up` is not along the line of sight.
glm::mat4 view_matrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// Eye to clip space of a pinhole camera. `fov_y` is the full vertical angle in degrees, in
/// (0, 180); `aspect` is width over height. Depth range and the direction of clip y follow the
/// conventions (gl: z in [-w, w]; vulkan and d3d: [0, w]; vulkan: clip y down).
glm::mat4 perspective_matrix(double fov_y, double aspect, const DepthAndShift& lens,
                             Conventions conventions);

/// Eye to clip space of a parallel projection that shows `height` units of length. `far` must be
/// finite.
glm::mat4 orthographic_matrix(double height, double aspect, const DepthAndShift& lens,
                              Conventions conventions);

}  // namespace quadrel
