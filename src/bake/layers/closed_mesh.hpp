// Meshes that enclose a solid.
#pragma once

#include <string>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Triangles by corners that are one where positions are equal; without those that have no three.
struct WeldedMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Throws InputError for a mesh that is not closed: names an edge that only one triangle has, or
/// that triangles run along more often one way than the other.
WeldedMesh weld_closed(const Mesh& mesh);

}  // namespace quadrel
