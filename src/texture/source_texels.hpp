// Level 0 of a texture before rounding: an image through swizzle, colour space and flip.
#pragma once

#include <vector>

#include "texture/mip.hpp"
#include "texture/swizzle.hpp"

namespace quadrel {

/// Values in multiples of units()[c]: where an image's codes stay linear they are whole numbers, so
/// that means of them tie exactly where the arithmetic of codes ties.
class SourceTexels : public LevelRows {
  public:
    SourceTexels(const Image& image, std::vector<SwizzleEntry> swizzle, bool srgb, bool flip_v);

    int channels() const { return static_cast<int>(swizzle_.size()); }
    /// What 1 is, of each channel.
    const std::vector<double>& units() const { return units_; }
    const double* row(int y, std::vector<double>& scratch) const override;

  private:
    bool is_decoded(int c) const;
    void fill_channel(const float* stored, int c, double* out) const;

    const Image& image_;
    std::vector<SwizzleEntry> swizzle_;
    bool srgb_, flip_v_;
    int codes_;  ///< largest code of the image's format, or 0
    std::vector<double> units_;
    std::vector<double> decoded_;  ///< linear value of each sRGB code, if the image has codes
};

}  // namespace quadrel
