// Meshes from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Most vertices and indices together of a file that can repeat itself (glTF), and most
/// vertices of a scene's meshes. Beyond, a damaged file is likelier than a model.
inline constexpr std::size_t max_mesh_vertices = std::size_t(1) << 25;

/// Reads a mesh by its extension: .obj (Wavefront), .gltf or .glb (glTF 2.0: all meshes of the
/// default scene's nodes, node transforms applied). Polygons become triangles. OBJ's v = 0 is the
/// texture's last row and glTF's the first: OBJ's v becomes 1 - v, unless `flip_v` says otherwise.
/// Throws InputError for a missing, truncated, malformed or empty file, numbers that are not
/// finite, indices out of range and more vertices than above.
Mesh load_mesh(const std::filesystem::path& file, std::optional<bool> flip_v = std::nullopt);

/// The files that make up a mesh: `file` itself, and the buffers that a .gltf refers to.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& file);

}  // namespace quadrel
