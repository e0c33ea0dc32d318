// Directional distance maps: for each block of dual cells, slice of heights and range of directions
// the height down to which every ray is free that starts there, anywhere in the block and slice,
// with any direction of the range. Ranges are the squares of a grid on the square of directions
// (quadrel/relief/direction_table.hpp).
//
// Rays that start at heights in [low, high] of a slice are, at height z, in the block moved by
// K t, t from max(0, low - z) to high - z. A part of the fall is free where the greatest height of
// all blocks that hold a rectangle around that is below the part. Parts are tried in steps that
// double where they are free and are halved where they are not, down to an eighth of a slice; what
// a part's maximum leaves free of it counts in any case. Bounds are those of rounding in the
// search, too: blocks are larger by a 32nd of a cell on each side, ranges of directions by 2^-12,
// slices by 2^-16.
#include "bake/direction/block_maxima.hpp"
#include "bake/direction/table_size.hpp"
#include "bake/generators.hpp"
#include "bake/rounding.hpp"
#include "quadrel/relief/direction_table.hpp"

namespace quadrel {

namespace {

constexpr double cell_guard = 1.0 / 32, direction_guard = 0x1p-12, height_guard = 0x1p-16;

/// Least and greatest of one axis.
struct Extent {
    double low, high;

    void take(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// The shifts, in cells while a ray falls by 1, of a range of directions.
struct Shifts {
    Extent x, y;
};

/// Of range (a, b). Each axis' shift is monotonic in both coordinates of the square, so that it is
/// least and greatest in corners.
Shifts shifts_of(const BakeJob& job, int a, int b, int directions) {
    const double depth = job.parameter("depth");
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Shifts shifts{{infinite, -infinite}, {infinite, -infinite}};
    const auto edge = [&](int n, int far) {
        return 2.0 * (n + far) / directions - 1 + (far ? direction_guard : -direction_guard);
    };
    for (int corner = 0; corner < 4; ++corner) {
        const vec2<double> k = direction_of_square(edge(a, corner % 2), edge(b, corner / 2));
        shifts.x.take(k.x * depth * job.plane.width);
        shifts.y.take(k.y * depth * job.plane.height);
    }
    return shifts;
}

/// The positions in cells that are reached from `start` in falls of [least, most].
Extent reached(const Extent& start, const Extent& shift, double least, double most) {
    return {start.low + std::min(shift.low * least, shift.low * most),
            start.high + std::max(shift.high * least, shift.high * most)};
}

class FreeFall {
  public:
    FreeFall(const BlockMaxima& maxima, int slices) : maxima_(maxima), slices_(slices) {}

    /// The height down to which all rays are free that start in slice k of the block.
    double operator()(const Extent& x, const Extent& y, int k, const Shifts& shifts) const {
        const double low = static_cast<double>(k) / slices_ - height_guard;
        const double high = static_cast<double>(k + 1) / slices_ + height_guard;
        const double least_step = 0.125 / slices_;
        double z = high;
        for (double step = 1.0 / slices_; z > 0 && step >= least_step;) {
            const double to = std::max(0.0, z - step);
            const double least = std::max(0.0, low - z), most = high - to;
            const Extent u = reached(x, shifts.x, least, most);
            const Extent v = reached(y, shifts.y, least, most);
            const double greatest = maxima_(u.low, u.high, v.low, v.high);
            const bool free = greatest < to;
            z = free ? to : std::min(z, greatest);
            step *= free ? 2 : 0.5;
        }
        return z;
    }

  private:
    const BlockMaxima& maxima_;
    int slices_;
};

/// The positions of block n, in cells.
Extent extent_of(int n, const BlockAxis& axis) {
    const int first = n * axis.side, end = std::min(first + axis.side, axis.cells.count);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    // The outermost cells of an axis that ends reach beyond it, where the field does not change.
    const bool begins = !axis.cells.periodic && n == 0;
    const bool ends = !axis.cells.periodic && n == axis.blocks - 1;
    return {begins ? -infinite : axis.cells.first + first - cell_guard,
            ends ? infinite : axis.cells.first + end + cell_guard};
}

}  // namespace

std::shared_ptr<Texture> bake_ddm(const BakeJob& job) {
    const Grid cells = cell_grid(job.plane.width, job.plane.height, job.sampler);
    const TableSize size = table_size(job, cells, job.whole("slices"));
    const auto table = make_table(job, size, BlockMaxima::floats(size.columns, size.rows));
    const BlockAxis u(cells.u, size.columns), v(cells.v, size.rows);
    const BlockMaxima maxima(job, u, v);
    const FreeFall free_fall(maxima, size.slices);
    const std::ptrdiff_t row_floats = std::ptrdiff_t(size.columns) * size.directions;
    job.rows(static_cast<int>(size.pictures()), 1, [&](int n) {
        const int a = n % size.directions, b = n / size.directions % size.directions;
        const int k = n / (size.directions * size.directions);
        const Shifts shifts = shifts_of(job, a, b, size.directions);
        float* const to = picture(*table, size, k, a, b);
        for (int j = 0; j < size.rows; ++j) {
            job.progress.check_time();
            const Extent y = extent_of(j, v);
            for (int i = 0; i < size.columns; ++i)
                to[j * row_floats + i] = round_up(free_fall(extent_of(i, u), y, k, shifts));
        }
    });
    reduce_directions(size, *table, [](float p, float q) { return std::max(p, q); });
    return table;
}

}  // namespace quadrel
