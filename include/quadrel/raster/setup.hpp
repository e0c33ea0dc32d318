// Triangle set-up: integer edge functions, facing, culling and the depth plane.
//
// Coordinates are window coordinates in 1/256 pixel (snap.hpp). E_i(X, Y) = a X + b Y + c belongs
// to the edge opposite of vertex i, is exact in int64, and is positive inside for both facings. The
// three sum to twice the area everywhere, so E_i / area2 is the barycentric coordinate of vertex i.
#pragma once

#include <array>
#include <cstdint>

#include "quadrel/raster/clip.hpp"
#include "quadrel/raster/snap.hpp"
#include "quadrel/raster/viewport.hpp"

namespace quadrel {

/// What the set-up needs to know besides the vertices.
struct RasterState {
    Viewport viewport;
    int subpixel_bits = 8;
    SnapRounding snap_rounding = SnapRounding::half_even;
    Cull cull = Cull::none;
};

RasterState raster_state(const Viewport& viewport, const HardwareModel& hardware,
                         Cull cull = Cull::none);

/// One edge function. A sample is inside if E >= threshold for all three edges.
///
/// Fill rule: a sample exactly on an edge is inside if the edge is a left edge (a > 0), or
/// horizontal with the triangle at larger window y (a == 0, b > 0): the threshold is 0, else 1.
/// That equals a strict test of the sample moved by (e, e^2), e -> 0+, so that of two triangles
/// sharing an edge exactly one covers the sample. (D3D11.3, 3.4.2.1, where y is down.)
struct EdgeFunction {
    std::int64_t a = 0, b = 0, c = 0;
    std::int64_t threshold = 0;
    std::int64_t operator()(std::int64_t x, std::int64_t y) const { return a * x + b * y + c; }
};

struct ScreenVertex {
    std::int32_t x = 0, y = 0;         ///< snapped, 1/256 pixel
    float window_x = 0, window_y = 0;  ///< unsnapped, pixels, by float32 arithmetic
    float clip_y = 0;
    double depth = 0;  ///< window depth, unclamped
    float w = 1;       ///< clip w, > 0 but for vertices that have not been clipped
};

/// A triangle of positive area, ready to be rasterized; vertices in the order they were given.
struct ScreenTriangle {
    std::array<ScreenVertex, 3> vertex;
    std::array<EdgeFunction, 3> edge;
    std::int64_t area2 = 0;  ///< twice the area in (1/256 pixel)^2, > 0
    bool front_facing = true;
    PixelRect bounds;  ///< pixels that can have covered samples, within the frame; not empty
    double depth1 = 0, depth2 = 0;  ///< depth = depth0 + (E1 depth1 + E2 depth2)
};

/// Twice the signed area of the snapped triangle, in (1/256 pixel)^2; positive if x turns towards
/// y.
std::int64_t signed_area2(const std::array<ScreenVertex, 3>& v);

/// A clip-space position divided and snapped. Where w < 0 it is the point of the window at which
/// the line through the eye and the position meets it.
ScreenVertex screen_vertex(const glm::dvec4& clip, const RasterState& state);

enum class SetupOutcome {
    drawn,
    zero_area,  ///< no area after snapping: covers nothing under any cull mode
    culled,
    off_frame,  ///< bounding box does not meet the frame
};

/// Sets up the triangle of three clip-space positions with w >= minimum_w. `triangle` is complete
/// only if the outcome is `drawn`.
///
/// Front-facing is counter-clockwise as seen on the screen, by the sign of the snapped area: in
/// window coordinates counter-clockwise where y is up (gl), clockwise where y is down.
SetupOutcome set_up_triangle(const std::array<glm::dvec4, 3>& clip, const RasterState& state,
                             ScreenTriangle& triangle);

/// Depth at the window point (x, y), in 1/256 pixel: linear in the window, evaluated in double from
/// the integer edges, clamped to [0, 1], rounded to float32.
float depth_at(const ScreenTriangle& triangle, std::int64_t x, std::int64_t y);

}  // namespace quadrel
