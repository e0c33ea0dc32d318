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

/// Whether this names one of the shapes that scenes have by name and that are closed: cube,
/// icosahedron, sphere, torus.
bool is_closed_shape(const std::string& name);

/// One of these shapes at its own size, or the mesh of a file, which may be open. Throws InputError
/// as load_mesh does.
Mesh closed_mesh(const std::string& shape_or_file);

}  // namespace quadrel
