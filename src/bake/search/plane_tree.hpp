// Greatest values over blocks of the whole plane, which has no end: a quadtree whose upper levels
// hold images of the stored grid (periodic axes) or what its outermost texels go on as (others).
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "bake/job.hpp"

namespace quadrel {

/// One axis of a block.
struct Span {
    int low, high;  ///< texels, inclusive, by stored indices counted on beyond the grid
    int node;       ///< -1 to TreeAxis::nodes(level), which stand for what lies beyond the grid
};

/// 2^level texels along an axis, fewer where an image of a periodic axis ends; above the levels
/// that are stored, 2^n images of such an axis.
struct Block {
    int level;
    Span u, v;
};

/// How one axis is halved.
class TreeAxis {
  public:
    TreeAxis(const GridAxis& axis, int top_level)
        : count_(axis.count), top_(top_level), periodic_(axis.periodic) {}

    /// Of the stored grid.
    int nodes(int level) const { return ((count_ - 1) >> std::min(level, top_)) + 1; }

    /// Texels of a block that no image ends in.
    int size(int level) const {
        return periodic_ && level >= top_ ? count_ << (level - top_) : 1 << level;
    }

    /// The block of a root level that starts at texel 0 (side 0) or ends before it (-1).
    Span root(int level, int side) const { return block(level, side * size(level), 0); }

    /// Half `k` (0 or 1) of a block; false if it is empty.
    bool half(const Span& whole, int level, int k, Span& half) const {
        half = block(level - 1, whole.low + k * size(level - 1), 2 * whole.node + k);
        half.high = std::min(half.high, whole.high);
        return half.low <= half.high;
    }

    Span texel(int x) const { return block(0, x, ((x % count_) + count_) % count_); }

  private:
    /// `node_in_image` matters within images of periodic axes.
    Span block(int level, int low, int node_in_image) const {
        const int node = !periodic_      ? std::clamp(low >> level, -1, nodes(level))
                         : level >= top_ ? 0
                                         : node_in_image;
        return {low, low + size(level) - 1, node};
    }

    int count_, top_;
    bool periodic_;
};

class PlaneTree {
  public:
    /// Of channel c of stored texel (x, y); never NaN.
    using Value = std::function<float(int x, int y, int c)>;

    /// `reach`: how many texels around the stored grid the roots hold at least.
    PlaneTree(const BakeJob& job, double share, int channels, int reach, const Value& value);

    /// Together the four roots are the plane as far as it is looked at.
    Block root(int k) const {
        return {root_level_, u_.root(root_level_, -(k % 2)), v_.root(root_level_, -(k / 2))};
    }

    /// Quarter `k` of a block above level 0; false if it is empty.
    bool quarter(const Block& block, int k, Block& quarter) const {
        quarter.level = block.level - 1;
        return u_.half(block.u, block.level, k % 2, quarter.u) &&
               v_.half(block.v, block.level, k / 2, quarter.v);
    }

    Block texel(int x, int y) const { return {0, u_.texel(x), v_.texel(y)}; }

    /// The greatest values of a block, one per channel.
    const float* greatest(const Block& block) const {
        const int level = std::min(block.level, top_level_);
        return &levels_[level][place(level, block.u.node, block.v.node)];
    }

  private:
    std::size_t place(int level, int node_u, int node_v) const {
        const std::size_t row = u_.nodes(level) + 2;
        return ((node_v + 1) * row + (node_u + 1)) * channels_;
    }
    void reduce_row(int level, int node_v);

    int channels_, top_level_, root_level_;
    TreeAxis u_, v_;
    std::vector<std::vector<float>> levels_;  ///< nodes from -1 to nodes() on both axes
};

}  // namespace quadrel
