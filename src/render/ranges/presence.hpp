// Where it depends on how vertices are snapped whether anything covers a pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quadrel/raster/setup.hpp"

namespace quadrel {

/// The pixels of one rectangle. An implementation may have each vertex elsewhere by `snapping`
/// pixels on each axis, and with it what is drawn near it; triangles that share vertices stay
/// together. So it is open whether a pixel is covered if triangles cover a part of the square of
/// that reach around its centre.
class Presence {
  public:
    Presence(const PixelRect& rect, double snapping);

    /// One of the triangles, of whatever material and depth.
    void add(const ScreenTriangle& triangle);

    /// Whether triangles cover a part of the pixel's square and not all of it, by its corners and
    /// its middle.
    bool is_open(int x, int y) const;

  private:
    std::size_t index(int x, int y) const;

    PixelRect rect_;
    std::int64_t reach_;                ///< in units of sub-pixels, not less than `snapping`
    std::vector<std::uint8_t> places_;  ///< of each pixel's square: those that are covered
    std::vector<bool> touched_;         ///< whether any part of it may be
};

}  // namespace quadrel
