// The node hierarchy of a glTF file.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "io/gltf/accessor.hpp"

namespace quadrel {

struct GltfNodes {
    std::vector<glm::dmat4> global;  ///< of every node, in the scene's space
    std::vector<int> drawn;          ///< visible nodes of the scene with meshes, parents first
};

/// Lays the nodes of the default scene out, the first one's if the file names none, or, without
/// scenes, all. Throws InputError unless nodes are disjoint trees and scenes list their roots.
GltfNodes lay_out_nodes(const GltfFile& file);

}  // namespace quadrel
