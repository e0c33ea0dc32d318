#include "quadrel/raster/viewport.hpp"

#include <algorithm>

namespace quadrel {

PixelRect intersect(const PixelRect& a, const PixelRect& b) {
    const PixelRect both{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1),
                         std::min(a.y1, b.y1)};
    return both.empty() ? PixelRect{} : both;
}

WindowPoint to_window(const Viewport& viewport, const glm::dvec4& clip) {
    const double x = clip.x / clip.w, y = clip.y / clip.w, z = clip.z / clip.w;
    const double half_width = viewport.width * 0.5, half_height = viewport.height * 0.5;
    const bool flip_y = viewport.conventions == Conventions::d3d;
    const bool symmetric_z = viewport.conventions == Conventions::gl;
    return {(x + 1) * half_width, (flip_y ? 1 - y : y + 1) * half_height,
            symmetric_z ? (z + 1) * 0.5 : z};
}

PixelRect frame_rect(const Viewport& viewport) { return {0, 0, viewport.width, viewport.height}; }

int flip_row(const Viewport& viewport, int y) {
    return viewport.conventions == Conventions::gl ? viewport.height - 1 - y : y;
}

PixelRect flip_rect(const Viewport& viewport, const PixelRect& rect) {
    if (viewport.conventions != Conventions::gl) return rect;
    return {rect.x0, viewport.height - rect.y1, rect.x1, viewport.height - rect.y0};
}

}  // namespace quadrel
