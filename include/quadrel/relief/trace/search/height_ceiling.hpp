// The greatest height over a rectangle of a height map, from a few nodes of its pyramids of maxima.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "quadrel/texture/height_maxima.hpp"

namespace quadrel {

/// A rectangle in units of the texture, in any tile of it; bounds inclusive.
struct UvBox {
    double u_low, u_high, v_low, v_high;
};

namespace detail {

inline std::int64_t floor_to_int(double x) {
    const auto truncated = static_cast<std::int64_t>(x);
    return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}

/// Consecutive cells or nodes of one axis; on a repeated axis they go on with 0 after the last.
struct AxisRange {
    std::int64_t first, count;
};

/// The stored cells that cells [low, high] stand for.
inline AxisRange stored_cells(std::int64_t low, std::int64_t high, std::int32_t first,
                              std::int32_t count, bool repeat) {
    const std::int64_t a = low - first, b = high - first;
    if (!repeat) {
        const std::int64_t stored = std::clamp<std::int64_t>(a, 0, count - 1);
        return {stored, std::clamp<std::int64_t>(b, 0, count - 1) - stored + 1};
    }
    if (b - a >= count) return {0, count};
    if (a >= 0 && a < count) return {a, b - a + 1};
    const std::int64_t rest = a % count;
    return {rest < 0 ? rest + count : rest, b - a + 1};
}

/// The nodes of 2^shift cells in which a range of an axis of `count` cells lies.
inline AxisRange nodes_around(const AxisRange& cells, std::int32_t count, int shift) {
    const std::int64_t nodes = ((count - 1) >> shift) + 1, first = cells.first >> shift;
    const std::int64_t last_cell = cells.first + cells.count - 1;
    if (last_cell < count) return {first, (last_cell >> shift) - first + 1};
    // Across the seam, to the node of the last cell or all around.
    const std::int64_t last = (last_cell - count) >> shift;
    return last >= first ? AxisRange{0, nodes} : AxisRange{first, nodes - first + last + 1};
}

/// The greatest of a rectangle of nodes.
inline float greatest_node(const TextureView& nodes, int level, const AxisRange& x,
                           const AxisRange& y) {
    const std::int64_t width = nodes.width[level], height = nodes.height[level];
    const float* const texels = nodes.texels + nodes.offset[level];
    float greatest = -std::numeric_limits<float>::infinity();
    for (std::int64_t j = 0; j < y.count; ++j) {
        const std::int64_t row = y.first + j < height ? y.first + j : y.first + j - height;
        // Rows on their own: a comparison then waits for few others.
        float of_row = -std::numeric_limits<float>::infinity();
        for (std::int64_t i = 0; i < x.count; ++i) {
            const std::int64_t column = x.first + i < width ? x.first + i : x.first + i - width;
            const float node = texels[row * width + column];
            of_row = node > of_row ? node : of_row;
        }
        greatest = of_row > greatest ? of_row : greatest;
    }
    return greatest;
}

}  // namespace detail

/// No look-up in the level at a point of the box gives more. `slack` as in HeightMaxima.
inline float height_ceiling(const LevelMaxima& level, const UvBox& box, double slack) {
    const auto low = [&](double u, std::int32_t texels) {
        return detail::floor_to_int(u * texels - 0.5 - slack);
    };
    const auto high = [&](double u, std::int32_t texels) {
        return detail::floor_to_int(u * texels - 0.5 + slack);
    };
    const auto x = detail::stored_cells(low(box.u_low, level.width), high(box.u_high, level.width),
                                        level.first_x, level.count_x, level.repeat_x != 0);
    const auto y =
        detail::stored_cells(low(box.v_low, level.height), high(box.v_high, level.height),
                             level.first_y, level.count_y, level.repeat_y != 0);
    // At most 5 nodes to either side.
    const auto size = static_cast<std::uint64_t>(std::max(x.count, y.count) - 1);
    const int shift = std::clamp(static_cast<int>(std::bit_width(size)) - 2, 1, level.nodes.levels);
    return detail::greatest_node(level.nodes, shift - 1,
                                 detail::nodes_around(x, level.count_x, shift),
                                 detail::nodes_around(y, level.count_y, shift));
}

/// The levels of a height map that a packet's look-ups read.
struct CeilingLevels {
    const HeightMaxima* maxima = nullptr;  ///< null: nothing is known
    int finest = 0, coarsest = 0;
    bool continuous = true;  ///< as HeightMaxima has it; false where look-ups take nearest texels
};

inline float height_ceiling(const CeilingLevels& levels, const UvBox& box) {
    const HeightMaxima& maxima = *levels.maxima;
    float greatest = height_ceiling(maxima.level[levels.finest], box, maxima.slack);
    for (int level = levels.finest + 1; level <= levels.coarsest; ++level)
        greatest = std::max(greatest, height_ceiling(maxima.level[level], box, maxima.slack));
    return greatest;
}

}  // namespace quadrel
