#include "bake/direction/table_size.hpp"

#include <fmt/format.h>

#include "quadrel/error.hpp"
#include "quadrel/relief/direction_table.hpp"

namespace quadrel {

TableSize table_size(const BakeJob& job, const Grid& grid, int slices) {
    const int wanted = std::min(job.whole("columns"), grid.u.count);
    const int side = block_side(grid.u.count, wanted);
    return {block_side(grid.u.count, side), block_side(grid.v.count, side), slices,
            job.whole("directions")};
}

std::shared_ptr<Texture> make_table(const BakeJob& job, const TableSize& size,
                                    std::int64_t working) {
    const std::int64_t floats = size.floats() + working;
    if (floats > most_table_floats) {
        const auto mebibytes = [](std::int64_t n) {
            return static_cast<double>(n) * sizeof(float) / (1 << 20);
        };
        throw InputError(
            "", "",
            fmt::format("a table of {} x {} columns, {} slices and {} x {} directions: {:.0f} MiB",
                        size.columns, size.rows, size.slices, size.directions, size.directions,
                        mebibytes(floats)),
            fmt::format("at most {:.0f} MiB: fewer columns, slices or directions",
                        mebibytes(most_table_floats)));
    }
    const auto table = job.make(1, size.slices,
                                {{size.columns * size.directions, size.rows * size.directions},
                                 {size.columns, size.rows},
                                 {2, 1}});
    for (int k = 0; k < size.slices; ++k)
        *table->level_texels(2, k) = static_cast<float>(job.parameter("depth"));
    return table;
}

float* picture(Texture& table, const TableSize& size, int k, int a, int b) {
    const std::ptrdiff_t row_floats = std::ptrdiff_t(size.columns) * size.directions;
    return table.level_texels(0, k) + b * size.rows * row_floats + a * size.columns;
}

}  // namespace quadrel
