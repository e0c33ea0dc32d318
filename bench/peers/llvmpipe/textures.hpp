// The scene's textures in OpenGL: the very texels that Quadrel's kernels read, level by level.
#pragma once

#include <epoxy/gl.h>

#include "quadrel/scene/scene.hpp"

namespace quadrel::peers {

/// The texture that the scene's only material has under `slot`, with its sampler; 0 where it has
/// none.
GLuint material_texture(const Scene& scene, const std::string& slot);

/// The scene's environment; 0 where it has none.
GLuint environment_texture(const Scene& scene);

/// Of the material's height map, a level of one channel for each halving: the greatest of four.
GLuint max_pyramid(const Scene& scene);

}  // namespace quadrel::peers
