// Tangents for meshes that have none, corner by corner of every triangle, so that no vertex has to
// be split where the UV map turns over or has a seam.
//
// Corners share a tangent when position, normal and UV are equal and their triangles have the same
// orientation in UV. What they share is summed in an order given by the values themselves: neither
// the order of triangles nor that of vertices changes a bit of the result. Arithmetic is in double,
// angles by num/'s atan2.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// dP/du and dP/dv of the surface at a corner, object space, in lengths a unit of UV.
struct UvTangents {
    glm::vec3 dPdu{0}, dPdv{0};
};

/// Averages of the incident triangles' dP/du and dP/dv: directions and lengths apart, both weighted
/// by the triangles' areas, so that opposed directions do not shorten each other. (F. Policarpo, M.
/// Oliveira and J. Comba, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces", 2005; the
/// weights are this renderer's choice.) Zero where all incident triangles have a degenerate UV map.
/// One entry per triangle and corner. The mesh needs texture coordinates, else all are zero.
std::vector<std::array<UvTangents, 3>> uv_tangents(const Mesh& mesh);

/// MikkTSpace (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), from its
/// description: every corner takes the unit dP/du of the triangles around, projected into the
/// plane of its normal and normalised, weighted by the triangles' angles at the corner; w is the
/// sign of their orientation in UV, bitangent = w cross(N, T). A triangle of a degenerate UV map
/// takes the tangent of its neighbours, or, having none, some vector perpendicular to the normal,
/// with w = 1. Meshes without normals take the triangles' own. One entry per triangle and corner.
///
/// Corners are grouped by equal values alone; the reference implementation also keeps triangles
/// apart that touch in the corner without sharing an edge.
std::vector<std::array<glm::vec4, 3>> mikkt_tangents(const Mesh& mesh);

}  // namespace quadrel
