// Range-maximum tables: the greatest height over any rectangle of cells from four look-ups. Layer
// b * (A + 1) + a holds, at cell (i, j), the maximum of the 2^a x 2^b cells from (i, j) on, where A
// is floor(log2(columns)); beyond the end a periodic axis goes on with its first cell, any other
// with its last. Source: Thonat et al., "RMIP: Displacement Ray Tracing via Inversion and Oblong
// Bounding", SIGGRAPH Asia 2023; Bender, Farach-Colton, "The LCA Problem Revisited", 2000.
#include "bake/generators.hpp"
#include "bake/pyramid/pyramid.hpp"

namespace quadrel {

namespace {

int floor_log2(int n) {
    int log = 0;
    while (n >> (log + 1) > 0) ++log;
    return log;
}

int beyond(int i, const GridAxis& axis) {
    return i < axis.count ? i : axis.periodic ? i - axis.count : axis.count - 1;
}

}  // namespace

std::shared_ptr<Texture> bake_rmq(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const Grid cells = cell_grid(plane.width, plane.height, job.sampler);
    const int columns = cells.u.count, rows = cells.v.count;
    const int last_a = floor_log2(columns), last_b = floor_log2(rows);
    const int layers = (last_a + 1) * (last_b + 1);
    const auto map = job.make(1, layers, {{columns, rows}});
    reduce_cells(job, 1.0 / layers, *map, 0, max_or_nan);
    for (int layer = 1; layer < layers; ++layer) {
        const int a = layer % (last_a + 1), b = layer / (last_a + 1);
        // Two halves side by side, or one above the other.
        const float* const half = map->level_texels(0, a > 0 ? layer - 1 : layer - last_a - 1);
        float* const to = map->level_texels(0, layer);
        job.rows(rows, 1.0 / layers, [&](int j) {
            const int other_j = a > 0 ? j : beyond(j + (1 << (b - 1)), cells.v);
            const std::size_t row = static_cast<std::size_t>(j) * columns;
            const std::size_t other_row = static_cast<std::size_t>(other_j) * columns;
            for (int i = 0; i < columns; ++i) {
                const int other_i = a > 0 ? beyond(i + (1 << (a - 1)), cells.u) : i;
                to[row + i] = max_or_nan(half[row + i], half[other_row + other_i]);
            }
        });
    }
    return map;
}

}  // namespace quadrel
