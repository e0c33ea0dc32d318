// Tiles that one triangle fills: their quads are known without drawing. One sample a pixel.
#pragma once

#include <vector>

#include "quadrel/raster/coverage.hpp"

namespace quadrel {

/// How many of the pixel centres of a rectangle a triangle covers.
enum class Cover { none, some, all };

/// Exact where it says all; some may be none. `rect` lies within the frame and is not empty.
Cover cover_of(const ScreenTriangle& triangle, const PixelRect& rect);

/// Whether all fragments in `rect`, of a triangle that covers all of it, pass the depth test
/// against a buffer that nothing was drawn to. Errs towards false.
bool passes_cleared(const ScreenTriangle& triangle, const PixelRect& rect, DepthCompare compare);

/// Appends what collect_quads does where the triangle is seen at every pixel of `rect`, whose sides
/// are even.
void append_whole_quads(const PixelRect& rect, std::uint32_t triangle,
                        std::vector<QuadCoverage>& quads);

}  // namespace quadrel
