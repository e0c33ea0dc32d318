// Tiles that one triangle fills: their quads are known without drawing.
#pragma once

#include <vector>

#include "quadrel/raster/coverage.hpp"

namespace quadrel {

/// How many of the samples in a rectangle a triangle covers.
enum class Cover { none, some, all };

/// `rect` lies within the frame and is not empty. Some may be none; with several samples per pixel
/// it may be all, too.
Cover cover_of(const ScreenTriangle& triangle, const PixelRect& rect, int samples);

/// Whether all fragments in `rect`, of a triangle that covers all of it, pass the depth test
/// against a buffer that nothing was drawn to. Errs towards false.
bool passes_cleared(const ScreenTriangle& triangle, const PixelRect& rect, int samples,
                    DepthCompare compare);

/// Appends what collect_quads does where the triangle is seen at every sample of `rect`, whose
/// sides are even.
void append_whole_quads(const PixelRect& rect, std::uint32_t triangle, int samples,
                        std::vector<QuadCoverage>& quads);

}  // namespace quadrel
