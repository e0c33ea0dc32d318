// Clipping of one triangle in homogeneous clip space.
//
// Clipped are the near and far planes, w > 0, and, for triangles that reach further than integers
// can hold, a guard band around the frame that no visible pixel is near. Inside of it nothing is
// clipped in x and y: the rasterizer cuts at the frame. The order is near, far, w, guard band.
//
// Watertight: a new vertex depends on the two end points of the cut edge alone, taken in an order
// made from their coordinates, so that both triangles at an edge get the same vertex bit for bit.
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "quadrel/raster/viewport.hpp"

namespace quadrel {

/// Vertices are clipped to w >= this. Edge values are below 2^58, so e/w and sums of three of them
/// stay finite in float32.
inline constexpr double minimum_w = 0x1p-64;

/// Half the width of the guard band around the window origin, in pixels: with 8 sub-pixel bits
/// coordinates have 28 bits, and edge functions (two products of 29-bit numbers) fit int64.
inline constexpr double guard_band = 0x1p19;

/// A vertex of the clipped polygon. `position` is in double: it decides coverage and depth.
/// `weight` are the coefficients of the triangle's three vertices, in clip space: sum 1, exactly
/// (1,0,0), (0,1,0) or (0,0,1) for original vertices; two of them non-zero on original edges.
struct ClipVertex {
    glm::dvec4 position{0.0};
    std::array<double, 3> weight{};
};

enum class ClipStatus {
    inside,      ///< nothing was cut: the three vertices are the original ones
    clipped,     ///< a polygon of 3 or more vertices
    outside,     ///< nothing left
    non_finite,  ///< a coordinate is NaN or infinite: the primitive is discarded (D3D11.3, 15.4)
};

/// A convex polygon in the winding order of the triangle; its triangles are (0, i, i+1).
struct ClippedPolygon {
    static constexpr int max_vertices = 3 + 7;
    ClipStatus status = ClipStatus::outside;
    int count = 0;
    std::array<ClipVertex, max_vertices> vertex;
};

/// Clips the triangle of three float32 clip-space positions.
ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& clip, const Viewport& viewport);

/// Coefficients for values that are linear in the window (noperspective): weight_i w_i / w. This is
/// the linear function through the three projected vertices continued to the clip vertex; it holds
/// for vertices behind the eye too, whose projections lie on the far side.
std::array<double, 3> window_linear_weights(const ClipVertex& vertex,
                                            const std::array<glm::vec4, 3>& clip);

/// A varying at a clip vertex: summed in double, rounded once. With weights (1,0,0) and so on the
/// value is the vertex's own, also beside infinities or NaN. Flat values are not to be combined:
/// they are the primitive's.
float weigh(const std::array<double, 3>& weight, float v0, float v1, float v2);

}  // namespace quadrel
