// Wavefront OBJ: the polygonal subset (v, vt, vn, f).
#pragma once

#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {

/// All faces of the file as one mesh; groups, smoothing groups and materials are ignored. A face
/// takes part in texture space (has normals) if all of its corners have a vt (a vn). Throws
/// InputError with the line.
MeshFile load_obj(const std::filesystem::path& file, const MeshFileOptions& options);

}  // namespace quadrel
