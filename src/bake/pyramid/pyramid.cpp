#include "bake/pyramid/pyramid.hpp"

#include "bake/generators.hpp"

namespace quadrel {

bool has_nan(const HeightPlane& plane) {
    int nans = 0;  // as a sum, for vector instructions
    for (const float height : plane.heights) nans += height != height ? 1 : 0;
    return nans > 0;
}

std::shared_ptr<Texture> cell_max_pyramid(const BakeJob& job, double share) {
    const HeightPlane& plane = job.plane;
    const Grid cells = cell_grid(plane.width, plane.height, job.sampler);
    const auto map = job.make(1, 1, pyramid_sizes(cells));
    with_max_of(plane, [&](const auto& reduce) {
        reduce_cells(job, share / 2, *map, 0, reduce);
        reduce_pyramid(job, share / 2, *map, 0, reduce);
    });
    return map;
}

std::shared_ptr<Texture> texel_max_pyramid(const BakeJob& job, double share) {
    const auto map = job.make(1, 1, pyramid_sizes(job.plane.grid));
    std::copy(job.plane.heights.begin(), job.plane.heights.end(), map->level_texels(0, 0));
    with_max_of(job.plane,
                [&](const auto& reduce) { reduce_pyramid(job, share, *map, 0, reduce); });
    return map;
}

std::shared_ptr<Texture> bake_max_mip(const BakeJob& job) { return cell_max_pyramid(job, 1); }

std::shared_ptr<Texture> bake_min_max(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const auto map =
        job.make(2, 1, pyramid_sizes(cell_grid(plane.width, plane.height, job.sampler)));
    reduce_cells(job, 0.25, *map, 0, min_or_nan);
    reduce_pyramid(job, 0.25, *map, 0, min_or_nan);
    reduce_cells(job, 0.25, *map, 1, max_or_nan);
    reduce_pyramid(job, 0.25, *map, 1, max_or_nan);
    return map;
}

std::shared_ptr<Texture> bake_texel_max(const BakeJob& job) { return texel_max_pyramid(job, 1); }

}  // namespace quadrel
