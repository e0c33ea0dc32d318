// glTF 2.0 meshes.
#pragma once

#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {

/// All triangles of the default scene's nodes in one mesh, in the scene's space. Throws InputError.
MeshFile load_gltf(const std::filesystem::path& file, const MeshFileOptions& options);

}  // namespace quadrel
