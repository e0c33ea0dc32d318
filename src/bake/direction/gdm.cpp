// Distances along rays: for nodes of place, height and direction, and of curvature, how far a ray
// goes to the bilinear field, in lengths of its way from height 1 to height 0.
//
// Generalized displacement maps have nodes at heights (k + 1) / slices; view-dependent ones are
// those of the top alone, of one layer for each curvature c of the base along the ray, in 1 / tile.
// Over such a base a ray that has gone t |K| sideways is higher by c / 2 (t |K|)^2 tiles, a height
// of 1 being `depth` tiles: it may leave the relief through the top, which is stored as -1.
#include "bake/direction/relief_ray.hpp"
#include "bake/direction/table_size.hpp"
#include "bake/generators.hpp"
#include "quadrel/relief/direction_table.hpp"

namespace quadrel {

namespace {

/// Height and curvature of a layer's nodes.
struct Layer {
    double z, curvature;
};

template <class LayerOf>
std::shared_ptr<Texture> bake_distances(const BakeJob& job, int layers, const LayerOf& layer_of) {
    const Grid& texels = job.plane.grid;
    const TableSize size = table_size(job, texels, layers);
    const auto table = make_table(job, size);
    const double depth = job.parameter("depth");
    const auto place = [](int n, int count, const GridAxis& axis) {
        return axis.first + (n + 0.5) * axis.count / count - 0.5;
    };
    const std::ptrdiff_t row_floats = std::ptrdiff_t(size.columns) * size.directions;
    const int side = size.directions;
    job.rows(static_cast<int>(size.pictures()), 1, [&](int n) {
        const int a = n % side, b = n / side % side, k = n / (side * side);
        const auto coordinate = [&](int node) { return 2.0 * node / (side - 1) - 1; };
        const vec2<double> K = direction_of_square(coordinate(a), coordinate(b)) * depth;
        const double square = K.x * K.x + K.y * K.y;
        const Layer layer = layer_of(k);
        float* const to = picture(*table, size, k, a, b);
        for (int j = 0; j < size.rows; ++j) {
            job.progress.check_time();
            for (int i = 0; i < size.columns; ++i) {
                ReliefRay ray{};
                ray.x = place(i, size.columns, texels.u);
                ray.y = place(j, size.rows, texels.v);
                ray.dx = K.x * job.plane.width;
                ray.dy = K.y * job.plane.height;
                ray.z = layer.z;
                ray.bend = layer.curvature / 2 * square / depth;
                const double t = first_meeting(job.plane, ray);
                to[j * row_floats + i] = static_cast<float>(t < 0 ? -1 : t);
            }
        }
    });
    reduce_directions(size, *table, [](float p, float q) { return std::min(p, q); });
    return table;
}

}  // namespace

std::shared_ptr<Texture> bake_gdm(const BakeJob& job) {
    const int slices = job.whole("slices");
    return bake_distances(job, slices, [=](int k) {
        return Layer{static_cast<double>(k + 1) / slices, 0};
    });
}

std::shared_ptr<Texture> bake_vdm(const BakeJob& job) {
    const int curvatures = job.whole("curvatures");
    const double most = job.parameter("curvature");
    const auto table = bake_distances(job, curvatures, [=](int k) {
        return Layer{1, curvatures == 1 ? 0 : most * (2.0 * k / (curvatures - 1) - 1)};
    });
    for (int k = 0; k < curvatures; ++k)
        table->level_texels(2, k)[1] = static_cast<float>(curvatures == 1 ? 0 : most);
    return table;
}

}  // namespace quadrel
