// One primitive of a glTF mesh.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "io/gltf/accessor.hpp"

namespace quadrel {

/// Vertices in the mesh's own space, morphed; lists are empty or as long as `positions`.
struct GltfPrimitive {
    std::vector<glm::dvec3> positions, normals, tangents;
    std::vector<float> handedness;  ///< 1 or -1, of tangents
    std::vector<glm::dvec2> uvs;    ///< of the chosen set, as stored
    bool morphed = false;           ///< normals and tangents are of any length
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads a primitive of triangles with the targets' `weights` (3.7.2.2); tangents only where there
/// are normals (3.7.2.1). Throws InputError, at `key`.
GltfPrimitive read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                             const std::vector<double>& weights, int uv_set,
                             const std::string& key);

}  // namespace quadrel
