// Vertices that lack a normal or a tangent get one for each triangle that they are a corner of.
#pragma once

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Null or otherwise unusable normals are replaced by those of the triangles, and vertices split
/// where these differ; a triangle without area takes what others left, else +z. Normals so long or
/// short that float squares of them overflow or vanish become unit vectors; others stay as they
/// are. A mesh that has none to keep ends up without normals, and shades flat.
void settle_normals(Mesh& mesh);

/// Null tangents (xyz) are replaced by MikkTSpace's, likewise. A mesh that has none to keep ends up
/// without tangents. Normals are settled before.
void settle_tangents(Mesh& mesh);

}  // namespace quadrel
