// Wavefront OBJ: the polygonal subset (v, vt, vn, f).
#pragma once

#include <filesystem>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// All faces of the file as one mesh; groups and materials are ignored. Normals (uvs) are kept
/// only if every corner has one. Throws InputError with the line.
Mesh load_obj(const std::filesystem::path& file, bool flip_v);

}  // namespace quadrel
