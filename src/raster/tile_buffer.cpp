#include "quadrel/raster/tile_buffer.hpp"

#include <algorithm>

#include "quadrel/check.hpp"
#include "quadrel/raster/samples.hpp"

namespace quadrel {

TileBuffer::TileBuffer(const PixelRect& rect, int samples, DepthCompare compare)
    : samples_(samples), compare_(compare) {
    QUADREL_CHECK(is_sample_count(samples), samples);
    reset(rect);
}

void TileBuffer::reset(const PixelRect& rect) {
    QUADREL_CHECK(rect.x0 >= 0 && rect.x0 % 2 == 0, rect.x0);
    QUADREL_CHECK(rect.y0 >= 0 && rect.y0 % 2 == 0, rect.y0);
    QUADREL_CHECK_OP(<=, rect.x1, max_frame_size);
    QUADREL_CHECK_OP(<=, rect.y1, max_frame_size);
    rect_ = rect;
    const auto whole_blocks = [](int n) { return (std::max(n, 0) + block_size - 1) / block_size; };
    stride_ = whole_blocks(rect.width()) * block_size;
    plane_ = std::size_t(stride_) * whole_blocks(rect.height()) * block_size;
    depth_.resize(plane_ * samples_);
    triangle_.resize(plane_ * samples_);
    clear();
}

void TileBuffer::clear() {
    std::fill(depth_.begin(), depth_.end(), compare_ == DepthCompare::less ? 1.0f : 0.0f);
    std::fill(triangle_.begin(), triangle_.end(), no_triangle);
}

bool TileBuffer::passes(int x, int y, int sample, float depth, std::uint32_t triangle) const {
    const std::size_t i = index(x, y, sample);
    const bool nearer = compare_ == DepthCompare::less ? depth < depth_[i] : depth > depth_[i];
    const bool earlier = depth == depth_[i] && triangle < triangle_[i];
    return nearer || (earlier && triangle_[i] != no_triangle);
}

void TileBuffer::write(int x, int y, int sample, float depth, std::uint32_t triangle) {
    const std::size_t i = index(x, y, sample);
    depth_[i] = depth;
    triangle_[i] = triangle;
}

}  // namespace quadrel
