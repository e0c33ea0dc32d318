// Where the four lanes of a quad evaluate their attributes, and the edge functions there.
#pragma once

#include <array>
#include <cstdint>

#include "quadrel/raster/coverage.hpp"
#include "quadrel/raster/interpolation.hpp"
#include "quadrel/raster/setup.hpp"

namespace quadrel {

/// A point for each lane, window coordinates in 1/256 pixel.
struct QuadPoints {
    std::array<std::int32_t, 4> x{}, y{};
};

/// The pixel centres of the quad whose lane 0 is pixel (x, y).
QuadPoints quad_centres(int x, int y);

/// D3D's centroid (D3D11.3, 3.5.5), lane by lane: the pixel centre if all samples are covered or
/// none is (helper lanes), else the covered sample of lowest index. Coverage is the triangle's, not
/// that of its visible samples, and doesn't depend on the tile.
QuadPoints quad_centroids(const ScreenTriangle& triangle, int x, int y, int samples);

/// E_i of the snapped triangle in each lane, exact: [edge][lane]. Edge i is opposite of vertex i.
using QuadEdges = std::array<std::array<std::int64_t, 4>, 3>;
QuadEdges edge_values(const ScreenTriangle& triangle, const QuadPoints& points);

/// The same as the interpolation takes them, four lanes of each edge, rounded to double (exact
/// within 4096 pixels of the window's origin).
void attribute_edges(const ScreenTriangle& triangle, const QuadPoints& points, double* e0,
                     double* e1, double* e2);

/// attribute_edges at the pixel centres of `quads` quads that lie side by side, from the one whose
/// lane 0 is pixel (x, y) on: the same values, stepped from quad to quad.
void attribute_edges(const ScreenTriangle& triangle, int x, int y, int quads, double* e0,
                     double* e1, double* e2);

/// Their derivatives in window x and y.
EdgeSlopes edge_slopes(const ScreenTriangle& triangle);

}  // namespace quadrel
