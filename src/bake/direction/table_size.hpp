// Of how many columns, slices and directions a table is (quadrel/relief/direction_table.hpp), and
// the memory that it takes.
#pragma once

#include "bake/job.hpp"

namespace quadrel {

/// A table, and what making it takes besides, has at most this many floats: 512 MiB.
inline constexpr std::int64_t most_table_floats = std::int64_t(1) << 27;

struct TableSize {
    int columns, rows;  ///< blocks of the stored grid
    int slices;
    int directions;  ///< along a side of the square

    std::int64_t pictures() const { return std::int64_t(slices) * directions * directions; }
    std::int64_t floats() const {
        return std::int64_t(columns) * rows * (pictures() + slices) + 2 * slices;
    }
};

/// By the parameters `columns` and `directions`, and `slices` of kinds that have some: a grid with
/// as many columns along u, or all if it has fewer, and blocks as long along v.
TableSize table_size(const BakeJob& job, const Grid& grid, int slices);

/// An empty table with its depth, and its `working` floats besides. Throws InputError with the
/// figure where both are more than most_table_floats.
std::shared_ptr<Texture> make_table(const BakeJob& job, const TableSize& size,
                                    std::int64_t working = 0);

/// The first texel of the picture of direction (a, b) in slice k; rows are
/// columns * directions texels apart.
float* picture(Texture& table, const TableSize& size, int k, int a, int b);

/// Fills level 1 with the `reduce` of each place over all directions.
template <class Reduce>
void reduce_directions(const TableSize& size, Texture& table, const Reduce& reduce) {
    const std::ptrdiff_t row_floats = std::ptrdiff_t(size.columns) * size.directions;
    for (int k = 0; k < size.slices; ++k) {
        float* to = table.level_texels(1, k);
        for (int j = 0; j < size.rows; ++j) {
            for (int i = 0; i < size.columns; ++i) {
                const auto at = [&](int n) {
                    const int a = n % size.directions, b = n / size.directions;
                    return picture(table, size, k, a, b)[j * row_floats + i];
                };
                float value = at(0);
                for (int n = 1; n < size.directions * size.directions; ++n)
                    value = reduce(value, at(n));
                *to++ = value;
            }
        }
    }
}

}  // namespace quadrel
