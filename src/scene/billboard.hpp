// Billboards: cards that turn to the camera, as the meshes that they are for a scene's view.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// The point that a projection sees from, homogeneous, in eye space: where clip x, y and w all
/// vanish.
glm::dvec4 centre_of_projection(const glm::mat4& projection);

/// The mesh of an object of the scene: its own, or the card that its billboard is for the scene's
/// camera, in `card`. Throws InputError for a billboard whose transform does not keep angles, or
/// whose sphere has the eye in it.
const Mesh& drawn_mesh(const Scene& scene, const Object& object, Mesh& card);

}  // namespace quadrel
