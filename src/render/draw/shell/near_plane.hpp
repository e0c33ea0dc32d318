// Whether the picture looks out of a shell: rays that begin inside of it enter through no face.
#pragma once

#include "quadrel/scene/scene.hpp"
#include "render/draw/shell.hpp"

namespace quadrel {

/// Throws an InputError that names the object if its shell meets the part of the near plane that
/// the camera sees, where views begin.
void check_near_plane(const Scene& scene, std::uint32_t object, const Shell& shell,
                      const Mesh& mesh);

}  // namespace quadrel
