// Distance volumes that are never too large. Voxels as in distance.cpp. Each texel's square is a
// column up to the greatest height that the bilinear field has over it, so the columns hold that
// field and the field of blocks as well. The squared distance from a voxel's centre to the nearest
// column is found exactly, one axis at a time, by lower envelopes of parabolas (Felzenszwalb,
// Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012); a column
// is a box, which on a line is its two ends and its middle. From the distance half the diagonal of
// a voxel is taken, what trilinear interpolation can add at most; values are not cut at 0, where
// that bound would be lost.
#include "bake/distance/distance_transform.hpp"
#include "bake/generators.hpp"
#include "bake/rounding.hpp"

namespace quadrel {

namespace {

/// The greatest bilinear height over the square of each stored texel.
std::vector<double> column_heights(const HeightPlane& plane) {
    std::vector<double> columns;
    columns.reserve(plane.heights.size());
    for (int j = 0; j < plane.grid.v.count; ++j) {
        for (int i = 0; i < plane.grid.u.count; ++i) {
            const auto h = [&](int di, int dj) {
                return static_cast<double>(plane.at(HeightPlane::wrap_step(i + di, plane.grid.u),
                                                    HeightPlane::wrap_step(j + dj, plane.grid.v)));
            };
            double most = h(0, 0);
            for (const int di : {-1, 1}) {
                most = std::max({most, (h(0, 0) + h(di, 0)) / 2, (h(0, 0) + h(0, di)) / 2});
                for (const int dj : {-1, 1})
                    most = std::max(most, (h(0, 0) + h(di, 0) + h(0, dj) + h(di, dj)) / 4);
            }
            columns.push_back(most);
        }
    }
    return columns;
}

/// Squared distances in voxels from the centres of slice k to the columns, in place of heights.
void transform_slice(const HeightPlane& plane, const std::vector<double>& columns, int k,
                     int slices, std::vector<double>& squares) {
    const int width = plane.grid.u.count, height = plane.grid.v.count;
    squares.resize(columns.size());
    for (std::size_t n = 0; n < columns.size(); ++n) {
        const double above = std::max(0.0, k + 0.5 - columns[n] * slices);
        squares[n] = above * above;
    }
    for (int j = 0; j < height; ++j)
        transform_boxes(&squares[static_cast<std::size_t>(j) * width], width, 1,
                        plane.grid.u.periodic);
    for (int i = 0; i < width; ++i)
        transform_boxes(&squares[i], height, width, plane.grid.v.periodic);
}

}  // namespace

std::shared_ptr<Texture> bake_distance_exact(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const int slices = job.whole("slices");
    const auto map = job.make(1, slices, {{plane.width, plane.height}});
    const std::vector<double> columns = column_heights(plane);
    // And what rounding can have added where parabolas cross.
    const double half_diagonal = std::sqrt(0.75) + 0x1p-18;
    job.rows(slices, 1, [&](int k) {
        std::vector<double> squares;
        transform_slice(plane, columns, k, slices, squares);
        float* out = map->level_texels(0, k);
        for (int j = 0; j < plane.height; ++j) {
            const std::size_t row =
                static_cast<std::size_t>(j - plane.grid.v.first) * plane.grid.u.count;
            for (int i = 0; i < plane.width; ++i) {
                const double distance = std::sqrt(squares[row + i - plane.grid.u.first]);
                *out++ = round_down((distance * (1 - safe_slack) - half_diagonal) / slices);
            }
        }
    });
    return map;
}

}  // namespace quadrel
