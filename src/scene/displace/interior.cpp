#include "scene/displace/interior.hpp"

#include <limits>

namespace quadrel::displacement {
namespace {

/// Rounded down; `b` is positive.
Int128 floor_quotient(Int128 a, Int128 b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

struct Rows {
    std::int64_t first, last;
};

/// Rows strictly between the lowest and the highest corner.
Rows rows_of(const Corners& triangle) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return {floor_cell(low) + 1, floor_cell(high - 1)};
}

}  // namespace

InteriorRow interior_row(const Corners& triangle, std::int64_t row) {
    constexpr std::int64_t far = std::numeric_limits<std::int32_t>::max();
    InteriorRow out{-far, far, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const Place &a = triangle[k], side = triangle[(k + 1) % 3] - a;
        // Inside: side.y * (x - a.x) < side.x * (y - a.y).
        const Int128 right = Int128(side.x) * (row * one - a.y) + Int128(side.y) * a.x;
        const Int128 factor = Int128(side.y) * one;
        if (factor > 0)
            out.high =
                std::min(out.high, static_cast<std::int64_t>(floor_quotient(right - 1, factor)));
        else if (factor < 0)
            out.low =
                std::max(out.low, static_cast<std::int64_t>(floor_quotient(-right, -factor)) + 1);
        else if (right <= 0)
            return {};
    }
    return out.low <= out.high ? out : InteriorRow{};
}

InteriorPoints::InteriorPoints(const Corners& triangle, std::uint32_t first) {
    const Rows rows = rows_of(triangle);
    first_row_ = rows.first;
    for (std::int64_t j = rows.first; j <= rows.last; ++j) {
        InteriorRow row = interior_row(triangle, j);
        row.first = first + count_;
        count_ += static_cast<std::uint32_t>(row.high - row.low + 1);
        rows_.push_back(row);
    }
}

std::uint64_t count_interior(const Corners& triangle) {
    const Rows rows = rows_of(triangle);
    std::uint64_t count = 0;
    for (std::int64_t j = rows.first; j <= rows.last; ++j) {
        const InteriorRow row = interior_row(triangle, j);
        count += static_cast<std::uint64_t>(row.high - row.low + 1);
    }
    return count;
}

}  // namespace quadrel::displacement
