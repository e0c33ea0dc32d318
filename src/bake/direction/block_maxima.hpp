// The greatest bilinear height over any rectangle of blocks of dual cells, from four values: tables
// of 2^a x 2^b blocks as those of BakeKind::rmq, but over blocks.
#pragma once

#include <vector>

#include "bake/job.hpp"

namespace quadrel {

/// Blocks of an axis of cells.
struct BlockAxis {
    GridAxis cells;
    int blocks, side;

    BlockAxis(const GridAxis& grid, int count);

    /// The blocks [first, first + count) that hold all of cells [low, high], which may lie
    /// anywhere; first is one of the stored, and of a periodic axis they go on with the first
    /// behind the last.
    struct Range {
        int first, count;
    };
    Range range(std::int64_t low, std::int64_t high) const;
};

class BlockMaxima {
  public:
    BlockMaxima(const BakeJob& job, const BlockAxis& u, const BlockAxis& v);

    /// Floats that maxima of so many blocks take.
    static std::int64_t floats(int columns, int rows);

    /// Over the cells that hold positions [low, high] of each axis, in cells.
    float operator()(double low_x, double high_x, double low_y, double high_y) const;

  private:
    void fill_blocks(const BakeJob& job);
    void fill_table(int a, int b);
    float* table(int a, int b) {
        return maxima_.data() + (std::size_t(b) * (last_a_ + 1) + a) * size();
    }
    const float* table(int a, int b) const {
        return maxima_.data() + (std::size_t(b) * (last_a_ + 1) + a) * size();
    }
    std::size_t size() const { return std::size_t(u_.blocks) * v_.blocks; }

    BlockAxis u_, v_;
    int last_a_, last_b_;
    std::vector<float> maxima_;
};

}  // namespace quadrel
