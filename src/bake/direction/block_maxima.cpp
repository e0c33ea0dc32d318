#include "bake/direction/block_maxima.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quadrel/relief/direction_table.hpp"

namespace quadrel {

namespace {

int last_log2(int n) { return std::bit_width(static_cast<unsigned>(n)) - 1; }

/// A block behind the last: the first ones again, or the last.
int block_at(int i, const BlockAxis& axis) {
    if (i < axis.blocks) return i;
    return axis.cells.periodic ? i - axis.blocks : axis.blocks - 1;
}

/// The cell that holds a position, as far away as anything is told from all cells.
std::int64_t cell_of(double x) {
    return static_cast<std::int64_t>(std::floor(std::clamp(x, -1e15, 1e15)));
}

}  // namespace

BlockAxis::BlockAxis(const GridAxis& grid, int count)
    : cells(grid), blocks(count), side(block_side(grid.count, count)) {}

BlockAxis::Range BlockAxis::range(std::int64_t low, std::int64_t high) const {
    const std::int64_t first = low - cells.first, last = high - cells.first;
    if (!cells.periodic) {
        const auto block = [&](std::int64_t n) {
            return static_cast<int>(std::clamp<std::int64_t>(n, 0, cells.count - 1) / side);
        };
        return {block(first), block(last) - block(first) + 1};
    }
    if (last - first >= cells.count) return {0, blocks};
    const std::int64_t turns =
        first >= 0 ? first / cells.count : -((cells.count - 1 - first) / cells.count);
    const auto from = static_cast<int>(first - turns * cells.count);
    const auto to = static_cast<int>(last - turns * cells.count);
    const int begin = from / side;
    const int end = to < cells.count ? to / side : blocks + (to - cells.count) / side;
    return {begin, std::min(end - begin + 1, blocks)};
}

BlockMaxima::BlockMaxima(const BakeJob& job, const BlockAxis& u, const BlockAxis& v)
    : u_(u), v_(v), last_a_(last_log2(u.blocks)), last_b_(last_log2(v.blocks)) {
    maxima_.resize(static_cast<std::size_t>(floats(u.blocks, v.blocks)));
    fill_blocks(job);
    for (int b = 0; b <= last_b_; ++b)
        for (int a = 0; a <= last_a_; ++a)
            if (a + b > 0) fill_table(a, b);
}

std::int64_t BlockMaxima::floats(int columns, int rows) {
    return std::int64_t(columns) * rows * (last_log2(columns) + 1) * (last_log2(rows) + 1);
}

float BlockMaxima::operator()(double low_x, double high_x, double low_y, double high_y) const {
    const BlockAxis::Range x = u_.range(cell_of(low_x), cell_of(high_x));
    const BlockAxis::Range y = v_.range(cell_of(low_y), cell_of(high_y));
    const int a = last_log2(x.count), b = last_log2(y.count);
    const float* const maxima = table(a, b);
    const int i = x.first, other_i = block_at(i + x.count - (1 << a), u_);
    const int j = y.first, other_j = block_at(j + y.count - (1 << b), v_);
    const auto at = [&](int column, int row) { return maxima[row * u_.blocks + column]; };
    return std::max(std::max(at(i, j), at(other_i, j)),
                    std::max(at(i, other_j), at(other_i, other_j)));
}

void BlockMaxima::fill_blocks(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    float* const blocks = table(0, 0);
    tbb::parallel_for(0, v_.blocks, [&](int n) {
        for (int m = 0; m < u_.blocks; ++m) {
            // The corners of its cells: a texel more than there are cells.
            const int first_i = u_.cells.first + m * u_.side,
                      first_j = v_.cells.first + n * v_.side;
            const int end_i = std::min(first_i + u_.side, u_.cells.first + u_.cells.count);
            const int end_j = std::min(first_j + v_.side, v_.cells.first + v_.cells.count);
            float most = plane.texel(first_i, first_j);
            for (int j = first_j; j <= end_j; ++j)
                for (int i = first_i; i <= end_i; ++i) most = std::max(most, plane.texel(i, j));
            blocks[n * u_.blocks + m] = most;
        }
    });
}

/// From two halves side by side, or one above the other.
void BlockMaxima::fill_table(int a, int b) {
    const float* const half = a > 0 ? table(a - 1, b) : table(a, b - 1);
    float* to = table(a, b);
    for (int j = 0; j < v_.blocks; ++j) {
        const int other_j = a > 0 ? j : block_at(j + (1 << (b - 1)), v_);
        for (int i = 0; i < u_.blocks; ++i) {
            const int other_i = a > 0 ? block_at(i + (1 << (a - 1)), u_) : i;
            *to++ = std::max(half[j * u_.blocks + i], half[other_j * u_.blocks + other_i]);
        }
    }
}

}  // namespace quadrel
