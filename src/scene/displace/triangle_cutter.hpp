// One triangle of the mesh, cut along the borders and diagonals of cells.
#pragma once

#include <cstddef>

#include "scene/displace/facets.hpp"

namespace quadrel::displacement {

/// Adds the facets of triangle t, and the vertices that are its own.
void cut_triangle(const Base& base, const Edges& edges, const Lattice& lattice, std::size_t t,
                  Facets& facets);

}  // namespace quadrel::displacement
