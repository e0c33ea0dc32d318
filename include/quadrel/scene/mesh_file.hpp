// Meshes from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Most vertices and indices together of a file that can repeat itself (glTF), and most
/// vertices of a scene's meshes. Beyond, a damaged file is likelier than a model.
inline constexpr std::size_t max_mesh_vertices = std::size_t(1) << 25;

/// A material of a glTF file: by its number from 0, -1 being none, or by its name.
using MaterialChoice = std::variant<int, std::string>;

/// How a file is to be read.
struct MeshFileOptions {
    /// v becomes 1 - v. By default it does for OBJ, whose v = 0 is the texture's last row, and not
    /// for glTF, whose v = 0 is the first.
    std::optional<bool> flip_v;
    int uv_set = 0;  ///< glTF: the n of TEXCOORD_n, >= 0. OBJ has one set, 0
    std::optional<MaterialChoice> material = {};  ///< glTF: the triangles of this one alone
};

/// A mesh, and what its file says beyond it.
struct MeshFile {
    Mesh mesh;
    int uv_sets = 0;  ///< sets of texture coordinates of the file
    /// glTF: names of the materials of the mesh's triangles, "materials[n]" for those without one.
    std::vector<std::string> materials;
    std::vector<std::string> ignored;  ///< by name, what the file holds and nothing reads
};

/// Reads a mesh by its extension: .obj (Wavefront), .gltf or .glb (glTF 2.0: all meshes of the
/// default scene's nodes, transforms, default morph weights and skins in the pose of the nodes
/// applied). Polygons become triangles. Triangles without texture coordinates in a mesh that has
/// some get one point of texture space (a degenerate map); corners without a normal get their
/// triangle's. So no normal of the mesh is null.
/// Throws InputError for a missing, truncated, malformed or empty file, numbers that are not
/// finite, indices out of range, more vertices than above, a set of texture coordinates or a
/// material that the file does not have, and glTF extensions that geometry needs and that are not
/// known.
MeshFile read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options = {});

/// Its mesh alone.
Mesh load_mesh(const std::filesystem::path& file, std::optional<bool> flip_v = std::nullopt);

/// Whether its name ends as those of meshes do.
bool is_mesh_file(const std::filesystem::path& file);

/// The files that make up a mesh: `file` itself, and the buffers that a .gltf refers to.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& file);

}  // namespace quadrel
