// Finer meshes for coarse ones.
#pragma once

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Beyond, 4^levels triangles for one are likelier a mistake than a wish.
inline constexpr int most_refinement_levels = 6;

/// Cuts every triangle in four, `levels` times, with the new vertices moved out of the facets by
/// the curvature that the normals at the ends of their edge tell of: the remedy of
/// "Derivative-Based Relief Mapping" (2012) against textures that tear at facets. Where that work
/// puts a vertex into the middle of a polygon, here edges are cut, so that facets on both sides of
/// an edge get smaller.
///
/// The point for the edge from p0 to p1 is the middle of the cubic that PN triangles put there
/// (A. Vlachos, J. Peters, C. Boyd and J. Mitchell, "Curved PN Triangles", 2001),
///     (p0 + p1) / 2 - (((p1 - p0).n0) n0 + ((p0 - p1).n1) n1) / 8,
/// its normal that of their quadratic; UV and tangents are averages. Positions and normals depend
/// on the edge's ends alone, told apart by position, never on the side from which it is seen, and
/// all edges are cut: no cracks and no T-junctions.
///
/// n0 and n1 are the means of all normals at a position, the triangles' where the mesh has none.
/// The result has these as its vertex normals, so creases get round; flat_shaded() makes facets of
/// it. `levels` in [0, most_refinement_levels]; 0 gives the mesh as it is.
Mesh refined_by_curvature(const Mesh& mesh, int levels);

}  // namespace quadrel
