// The numbers of a scene that its programs read, by the names that shaders have for them.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "export/export.hpp"
#include "quadrel/quad/uniforms.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Components one after the other.
using UniformValues = NamedFloats;

/// Camera and lights; the same for all.
UniformValues frame_values_by_name(const FrameUniforms& frame);

UniformValues material_values_by_name(const Material& material);

UniformValues object_values_by_name(const Scene& scene, const Object& object);

}  // namespace quadrel
