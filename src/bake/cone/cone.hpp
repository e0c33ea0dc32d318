// What all cone maps share: a texture of {height, ratio}, the ratios found texel by texel.
//
// The ratio of a cone is its radius, in tile units, at unit height above the apex.
#pragma once

#include <cmath>

#include "bake/job.hpp"
#include "bake/rounding.hpp"

namespace quadrel {

/// Distances in tile units between texels by their offsets. Monotonic in each offset, rounding
/// included.
class TileMetric {
  public:
    TileMetric(int width, int height) : width_(width), height_(height) {}
    double operator()(double di, double dj) const {
        const double u = di / width_, v = dj / height_;
        return std::sqrt(u * u + v * v);
    }

  private:
    double width_, height_;
};

/// The texel that a cone stands on, by stored indices.
struct Apex {
    int i, j;
    double height;
};

/// Rounds a ratio down: never wider than the true cone, whatever double has rounded.
inline float safe_ratio(double ratio, double limit) {
    return round_down(ratio < limit ? ratio * (1 - safe_slack) : limit);
}

/// Radius over height of the cone that just reaches a point `rise` above the apex.
inline double cone_ratio(double distance, double rise) { return distance / rise; }

/// Calls set(apex, texel) for every texel of the texture, in parallel by a copy of `set` for each
/// row; `texel` is what level 0 of the first layer of `map` stores for it.
template <class Set>
void for_each_apex(const BakeJob& job, double share, Texture& map, const Set& set) {
    const HeightPlane& plane = job.plane;
    const int channels = map.view().channels;
    float* const texels = map.level_texels(0, 0);
    // In a large map even a row takes long.
    constexpr int texels_between_checks = 16;
    job.rows(plane.height, share, [&](int row) {
        Set set_of_row = set;
        for (int column = 0; column < plane.width; ++column) {
            if (column % texels_between_checks == 0) job.progress.check_time();
            const int i = column - plane.grid.u.first, j = row - plane.grid.v.first;
            set_of_row(Apex{i, j, plane.at(i, j)},
                       texels + (static_cast<std::size_t>(row) * plane.width + column) * channels);
        }
    });
}

/// A map of heights and ratios; `ratio` is copied for each row.
template <class Ratio>
std::shared_ptr<Texture> make_cone_map(const BakeJob& job, double share, const Ratio& ratio) {
    const auto map = job.make(2, 1, {{job.plane.width, job.plane.height}});
    for_each_apex(job, share, *map, [ratio = ratio](const Apex& apex, float* texel) mutable {
        texel[0] = static_cast<float>(apex.height);
        texel[1] = ratio(apex);
    });
    return map;
}

/// How many texels away one may be for a cone of ratio `limit` to reach it, at most 2^27: a plane
/// that has not repeated by then is constant.
int cone_reach(const HeightPlane& plane, double limit);

/// Replaces each ratio (channel 1) by the least of its 3x3 neighbours in the plane, so that a
/// bilinear look-up is nowhere wider than the cones of the texels around it.
void filter_ratios(const BakeJob& job, double share, Texture& map);

/// Rounds ratios (channel 1) down to unorm codes, if the kind's parameter `bits` asks for it.
void quantise_ratios(const BakeJob& job, Texture& map);

}  // namespace quadrel
