// From clip space to window coordinates, and between window and image coordinates.
#pragma once

#include <glm/vec4.hpp>

#include "quadrel/scene/settings.hpp"

namespace quadrel {

/// Half-open rectangle of pixels. In window coordinates unless a name says "image": pixel (x, y)
/// covers [x, x+1) x [y, y+1).
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    bool operator==(const PixelRect&) const = default;
};

/// The common part; empty (all zero) when there is none.
PixelRect intersect(const PixelRect& a, const PixelRect& b);

/// Largest width and height of a frame, in pixels.
inline constexpr int max_frame_size = 65536;

/// The whole frame: origin (0, 0), sides in [1, max_frame_size], depth range [0, 1].
struct Viewport {
    int width = 1, height = 1;
    Conventions conventions = Conventions::gl;
};

/// Window coordinates in pixels, and depth: 0 at the near plane, 1 at the far plane (before any
/// clamping).
struct WindowPoint {
    double x = 0, y = 0, z = 0;
};

/// Perspective divide and viewport transform of a clip-space position with w > 0.
///   x = (x/w + 1) W/2 always;
///   gl      y = (y/w + 1) H/2 (window y up),   z = (z/w + 1)/2
///   vulkan  y = (y/w + 1) H/2 (window y down), z = z/w
///   d3d     y = (1 - y/w) H/2 (window y down), z = z/w
/// Sources: OpenGL 4.6, 13.8.1; Vulkan, "Controlling the Viewport"; D3D11.3, 15.6.
WindowPoint to_window(const Viewport& viewport, const glm::dvec4& clip);

/// All pixels of the frame, in window coordinates.
PixelRect frame_rect(const Viewport& viewport);

/// Image row (from the top) of window row y, and the reverse: the map is its own inverse.
int flip_row(const Viewport& viewport, int y);

/// A rectangle in image coordinates (from the top-left) as window coordinates, and the reverse.
PixelRect flip_rect(const Viewport& viewport, const PixelRect& rect);

}  // namespace quadrel
