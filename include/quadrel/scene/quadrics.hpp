// A quadric for each corner of a mesh, which says how the mesh curves away from its tangent plane.
//
// Source: M. M. Oliveira, F. Policarpo, "An Efficient Representation for Surface Details", UFRGS
// RP-351, 2005, of which the abstract and what shaders make of it could be read: each vertex has
// two coefficients of a quadric in its tangent space, found by least squares and interpolated. With
// x along the tangent, y along the bitangent, both perpendicular to the unit normal N at the vertex
// P,
//
//     depth below the tangent plane = a x^2 + b y^2:    1 / (2 R), twice, of a sphere of radius R
//
// is fitted to the vertices that share an edge with P; which vertices the report takes is not
// known. Arithmetic is in double, and sums are taken in an order that no renumbering changes.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// (a, b) a triangle and corner, in 1 / unit of the mesh's positions; positive where the mesh is
/// convex. Vertices of equal position and normal are one, whatever their UV; edges to others are no
/// neighbours, so that faces which meet in a crease stay as flat as they are. 0 in meshes without
/// normals, and at corners whose UV map or neighbourhood is degenerate. Where all neighbours lie on
/// the diagonals of x and y, which leaves one of the two open, a and b are equal.
std::vector<std::array<glm::vec2, 3>> fitted_quadrics(const Mesh& mesh);

}  // namespace quadrel
