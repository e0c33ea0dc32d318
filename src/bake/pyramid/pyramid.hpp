// Pyramids of bounds: nodes of 2x2, sizes rounded up, to 1x1.
#pragma once

#include <algorithm>

#include "bake/job.hpp"

namespace quadrel {

/// Sizes of all levels over a grid.
inline std::vector<LevelSize> pyramid_sizes(const Grid& grid) {
    std::vector<LevelSize> sizes{{grid.u.count, grid.v.count}};
    while (sizes.back() != LevelSize(1, 1)) {
        const auto [width, height] = sizes.back();
        sizes.emplace_back((width + 1) / 2, (height + 1) / 2);
    }
    return sizes;
}

/// NaN if either is, so that a bound over a broken map says so.
inline float max_or_nan(float a, float b) { return b > a || b != b ? b : a; }
inline float min_or_nan(float a, float b) { return b < a || b != b ? b : a; }

/// Fills channel c of levels 1 and above of a pyramid with the `reduce` of each node's children.
template <class Reduce>
void reduce_pyramid(const BakeJob& job, double share, Texture& pyramid, int c,
                    const Reduce& reduce) {
    const TextureView& view = pyramid.view();
    const int channels = view.channels;
    for (int level = 1; level < view.levels; ++level) {
        const float* const from = pyramid.level_texels(level - 1, 0);
        float* const to = pyramid.level_texels(level, 0);
        const int width = view.width[level - 1], height = view.height[level - 1];
        const auto finer = [&](int x, int y) {
            const std::size_t row = std::min(y, height - 1);
            return from[(row * width + std::min(x, width - 1)) * channels + c];
        };
        job.rows(view.height[level], share / view.levels, [&](int y) {
            float* out = to + static_cast<std::size_t>(y) * view.width[level] * channels + c;
            for (int x = 0; x < view.width[level]; ++x, out += channels) {
                *out = reduce(reduce(finer(2 * x, 2 * y), finer(2 * x + 1, 2 * y)),
                              reduce(finer(2 * x, 2 * y + 1), finer(2 * x + 1, 2 * y + 1)));
            }
        });
    }
}

/// Fills channel c of level 0 with the `reduce` of the corners of each stored dual cell.
template <class Reduce>
void reduce_cells(const BakeJob& job, double share, Texture& pyramid, int c, const Reduce& reduce) {
    const HeightPlane& plane = job.plane;
    const Grid cells = cell_grid(plane.width, plane.height, job.sampler);
    const int channels = pyramid.view().channels;
    float* const to = pyramid.level_texels(0, 0);
    job.rows(cells.v.count, share, [&](int j) {
        float* out = to + static_cast<std::size_t>(j) * cells.u.count * channels + c;
        for (int i = 0; i < cells.u.count; ++i, out += channels) {
            const int x = cells.u.first + i, y = cells.v.first + j;
            *out = reduce(reduce(plane.texel(x, y), plane.texel(x + 1, y)),
                          reduce(plane.texel(x, y + 1), plane.texel(x + 1, y + 1)));
        }
    });
}

/// The max-mip map, also what other generators search.
std::shared_ptr<Texture> cell_max_pyramid(const BakeJob& job, double share);
/// The texel-max map.
std::shared_ptr<Texture> texel_max_pyramid(const BakeJob& job, double share);

}  // namespace quadrel
