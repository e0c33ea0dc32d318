// Skins: vertices that joints move (glTF 2.0, 3.7.3).
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "io/gltf/accessor.hpp"

namespace quadrel {

/// The matrices that bring a skin's vertices from mesh space into the scene's, one a joint: the
/// joint's node's after the inverse bind matrix. Throws InputError.
std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int skin,
                                       const std::vector<glm::dmat4>& node_matrices);

/// The matrices of a primitive's vertices: means of `joints` by WEIGHTS_n of JOINTS_n, over all
/// sets. Weights that do not quite add up to 1 are divided by their sum. Throws InputError, at
/// `key`, for a primitive without them, joints that the skin has not, and weights below 0 or all 0.
std::vector<glm::dmat4> skin_vertices(const GltfFile& file, const tinygltf::Primitive& primitive,
                                      std::size_t vertex_count,
                                      const std::vector<glm::dmat4>& joints,
                                      const std::string& key);

}  // namespace quadrel
