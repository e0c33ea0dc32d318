// The lattice points strictly within a triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/displace/cell_polygon.hpp"

namespace quadrel::displacement {

/// Columns low to high of one row of the lattice; none where low is above high.
struct InteriorRow {
    std::int64_t low = 0, high = -1;
    std::uint32_t first = 0;  ///< number of the point in column `low`

    bool holds(std::int64_t i) const { return low <= i && i <= high; }
    std::uint32_t number(std::int64_t i) const {
        return first + static_cast<std::uint32_t>(i - low);
    }
};

InteriorRow interior_row(const Corners& triangle, std::int64_t row);

/// All rows that have some, numbered from `first` on, row by row.
class InteriorPoints {
  public:
    InteriorPoints() = default;
    InteriorPoints(const Corners& triangle, std::uint32_t first);

    std::uint32_t count() const { return count_; }
    /// Of any row.
    const InteriorRow& row(std::int64_t j) const {
        const std::int64_t n = j - first_row_;
        return n < 0 || n >= static_cast<std::int64_t>(rows_.size())
                   ? none_
                   : rows_[static_cast<std::size_t>(n)];
    }
    std::int64_t first_row() const { return first_row_; }
    std::int64_t last_row() const {
        return first_row_ + static_cast<std::int64_t>(rows_.size()) - 1;
    }

  private:
    std::int64_t first_row_ = 0;
    std::vector<InteriorRow> rows_;
    InteriorRow none_;
    std::uint32_t count_ = 0;
};

/// How many there are.
std::uint64_t count_interior(const Corners& triangle);

}  // namespace quadrel::displacement
