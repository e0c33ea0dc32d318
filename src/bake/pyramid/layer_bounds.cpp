#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "bake/generators.hpp"
#include "bake/pyramid/pyramid.hpp"

namespace quadrel {
namespace {

/// Where a cell has nothing: no ray is in [2, -1].
constexpr float no_front = 2, no_back = -1;

struct PairBounds {
    float front = no_front, back = no_back;
};

/// Of one pair of layers at a cell's corners.
PairBounds bounds_of(const std::array<float, 4>& fronts, const std::array<float, 4>& backs) {
    PairBounds bounds;
    bool is_solid = false, is_broken = false;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        is_solid = is_solid || fronts[corner] < backs[corner];
        is_broken = is_broken || std::isnan(fronts[corner]) || std::isnan(backs[corner]);
    }
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    if (is_broken) return {nan, nan};
    if (!is_solid) return bounds;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        bounds.front = std::min(bounds.front, fronts[corner]);
        bounds.back = std::max(bounds.back, backs[corner]);
    }
    return bounds;
}

/// One layer of the source, as its wrap modes continue it. One that the source lacks lies at the
/// bottom.
class LayerPlane {
  public:
    LayerPlane(const BakeJob& job, int layer) {
        if (layer < job.source.view().channels) plane_.emplace(job.source, job.sampler, layer);
    }
    /// At the corners of a cell.
    std::array<float, 4> corners(int i, int j) const {
        if (!plane_) return {1, 1, 1, 1};
        return {plane_->texel(i, j), plane_->texel(i + 1, j), plane_->texel(i, j + 1),
                plane_->texel(i + 1, j + 1)};
    }

  private:
    std::optional<HeightPlane> plane_;
};

/// Fills a pair of channels of level 0.
void fill_cells(const BakeJob& job, double share, const Grid& cells, int pair, Texture& map) {
    const LayerPlane front(job, 2 * pair), back(job, 2 * pair + 1);
    job.rows(cells.v.count, share, [&](int row) {
        float* to = map.level_texels(0, 0) + std::ptrdiff_t(row) * cells.u.count * 4 + 2 * pair;
        for (int column = 0; column < cells.u.count; ++column, to += 4) {
            const int i = cells.u.first + column, j = cells.v.first + row;
            const PairBounds bounds = bounds_of(front.corners(i, j), back.corners(i, j));
            to[0] = bounds.front;
            to[1] = bounds.back;
        }
    });
}

}  // namespace

std::shared_ptr<Texture> bake_layer_bounds(const BakeJob& job) {
    const Grid cells = cell_grid(job.plane.width, job.plane.height, job.sampler);
    const auto map = job.make(4, 1, pyramid_sizes(cells));
    for (int pair = 0; pair < 2; ++pair) {
        fill_cells(job, 0.25, cells, pair, *map);
        reduce_pyramid(job, 0.125, *map, 2 * pair, min_or_nan);
        reduce_pyramid(job, 0.125, *map, 2 * pair + 1, max_or_nan);
    }
    return map;
}

}  // namespace quadrel
