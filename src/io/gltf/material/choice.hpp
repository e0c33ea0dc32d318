// Materials of a glTF file by number and name.
#pragma once

#include "io/gltf/accessor.hpp"
#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {

/// The number of the material that is meant, -1 for none. Throws InputError where the file has no
/// such one, or several of the name.
int gltf_material(const GltfFile& file, const MaterialChoice& choice);

/// Its name; "materials[n]" where it has none, "no material" for -1.
std::string gltf_material_name(const GltfFile& file, int material);

}  // namespace quadrel
