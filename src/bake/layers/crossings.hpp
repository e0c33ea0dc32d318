// Where rays through texel centres go through a mesh.
#pragma once

#include <functional>
#include <vector>

#include "bake/layers/closed_mesh.hpp"

namespace quadrel {

/// A mesh as it is looked at: x and y in texels, z the depth in [0, 1].
struct ProjectedMesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// One surface at a texel's centre.
struct Crossing {
    double depth;
    int winding;  ///< 1 into the solid of an outward-facing triangle, -1 out of it
};

/// The crossings of each texel of a map, row by row, by depth. Each triangle has its centres by
/// integers: positions are rounded to 2^-24 of a texel, and a centre that lies on an edge belongs
/// to one side of it, as if it lay a little to the right, and still less upwards.
///
/// `progress` is told from 0 to 1 how much is done, row by row of each triangle; what it throws
/// ends the work.
std::vector<std::vector<Crossing>> texel_crossings(const ProjectedMesh& mesh, int width, int height,
                                                   const std::function<void(double)>& progress);

}  // namespace quadrel
