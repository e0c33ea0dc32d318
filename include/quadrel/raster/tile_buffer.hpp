// Depth and visible triangle of every sample of a part of the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrel/raster/viewport.hpp"

namespace quadrel {

/// The triangle index of samples that nothing covers.
inline constexpr std::uint32_t no_triangle = 0xffffffffu;

/// Which depth is nearer: less (cleared to 1) or, for reversed z, greater (cleared to 0).
enum class DepthCompare { less, greater };

/// A tile: one plane of float32 depths and triangle indices per sample.
///
/// A fragment replaces a sample if it is strictly nearer, or at equal depth if its triangle index
/// is smaller than that of a triangle already there. The result does not depend on the order of
/// triangles, and is the one of in-order drawing under a strict comparison.
class TileBuffer {
  public:
    static constexpr int block_size = 8;  ///< planes are stored in whole blocks, in pixels

    /// `rect` is in window coordinates within the frame, its x0 and y0 are even and not negative;
    /// `samples` is 1, 2, 4, 8 or 16.
    TileBuffer(const PixelRect& rect, int samples, DepthCompare compare = DepthCompare::less);

    /// Forgets everything drawn.
    void clear();

    /// Clears and moves to another rectangle, keeping memory.
    void reset(const PixelRect& rect);

    const PixelRect& rect() const { return rect_; }
    int samples() const { return samples_; }
    DepthCompare compare() const { return compare_; }

    float depth(int x, int y, int sample) const { return depth_[index(x, y, sample)]; }
    std::uint32_t triangle(int x, int y, int sample) const {
        return triangle_[index(x, y, sample)];
    }

    /// Whether a fragment of this depth would be written.
    bool passes(int x, int y, int sample, float depth, std::uint32_t triangle) const;
    /// Writes unconditionally.
    void write(int x, int y, int sample, float depth, std::uint32_t triangle);

    /// Elements of one row of a plane, and the position of (x, y, sample) in the planes below.
    int stride() const { return stride_; }
    std::size_t index(int x, int y, int sample) const {
        return sample * plane_ + std::size_t(y - rect_.y0) * stride_ + (x - rect_.x0);
    }
    float* depths() { return depth_.data(); }
    const float* depths() const { return depth_.data(); }
    std::uint32_t* triangles() { return triangle_.data(); }
    const std::uint32_t* triangles() const { return triangle_.data(); }

  private:
    PixelRect rect_;
    int samples_;
    DepthCompare compare_;
    int stride_ = 0;
    std::size_t plane_ = 0;
    std::vector<float> depth_;
    std::vector<std::uint32_t> triangle_;
};

}  // namespace quadrel
