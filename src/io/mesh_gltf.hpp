// glTF 2.0 meshes.
#pragma once

#include <filesystem>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// All triangles of the default scene's nodes in one mesh, in the scene's space. Normals, uvs
/// (TEXCOORD_0) and tangents are kept only if every primitive has them. Throws InputError.
Mesh load_gltf(const std::filesystem::path& file, bool flip_v);

}  // namespace quadrel
