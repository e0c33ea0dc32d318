// Level 0 of a texture before rounding: an image through swizzle, colour space and flip.
#pragma once

#include <vector>

#include "texture/swizzle.hpp"

namespace quadrel {

/// Values in multiples of 1 / unit(c): where an image's codes stay linear they are whole numbers,
/// so that means of them tie exactly where the arithmetic of codes ties.
class SourceTexels {
  public:
    SourceTexels(const Image& image, std::vector<SwizzleEntry> swizzle, bool srgb, bool flip_v);

    int channels() const { return static_cast<int>(swizzle_.size()); }
    double unit(int c) const { return unit_[static_cast<std::size_t>(c)]; }
    double operator()(int x, int y, int c) const;

  private:
    bool is_decoded(int c) const;

    const Image& image_;
    std::vector<SwizzleEntry> swizzle_;
    bool srgb_, flip_v_;
    int codes_;  ///< largest code of the image's format, or 0
    std::vector<double> unit_;
    std::vector<double> decoded_;  ///< linear value of each sRGB code, if the image has codes
};

}  // namespace quadrel
