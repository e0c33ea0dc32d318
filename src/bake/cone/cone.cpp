// Conservative cone maps. Source: Dummer, "Cone Step Mapping: An Iterative
// Ray-Heightfield Intersection Algorithm", 2006. Differs in measuring distances in the units of the
// tile on both axes, so that maps that are not square are right, in rounding down, and in leaving
// out texels that cannot narrow a cone further. The robust
// map adds the 3x3 minimum and the rounding of Ban, Valasek, Balint, Vad, "Robust Cone Step
// Mapping", EGSR 2024.
#include "bake/cone/cone.hpp"

#include "bake/generators.hpp"
#include "bake/search/sector_search.hpp"

namespace quadrel {

namespace {

std::shared_ptr<Texture> all_cones(const BakeJob& job, double share) {
    const HeightPlane& plane = job.plane;
    const double limit = job.parameter("c_max");
    const PlaneTree tree(job, share * 0.01, 1, cone_reach(plane, limit),
                         [&](int x, int y, int) { return plane.at(x, y); });
    const WholeCircle directions;
    const TileMetric metric(plane.width, plane.height);
    return make_cone_map(
        job, share * 0.99,
        [limit, search = SectorSearch(tree, directions, metric, limit)](const Apex& apex) mutable {
            return safe_ratio(search(apex)[0], limit);
        });
}

}  // namespace

int cone_reach(const HeightPlane& plane, double limit) {
    const auto [low, high] = std::minmax_element(plane.heights.begin(), plane.heights.end());
    const double rise = double(*high) - *low;
    // A texel more for what is rounded here.
    const double texels = limit * rise * std::max(plane.width, plane.height) + 1;
    return static_cast<int>(std::min(texels, 0x1p27)) + 1;
}

void filter_ratios(const BakeJob& job, double share, Texture& map) {
    const auto [width, height] = LevelSize(job.plane.width, job.plane.height);
    float* const texels = map.level_texels(0, 0);
    std::vector<float> ratios(static_cast<std::size_t>(width) * height);
    for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] = texels[2 * k + 1];
    job.rows(height, share, [&, w = width](int j) {
        for (int i = 0; i < w; ++i) {
            float least = ratios[static_cast<std::size_t>(j) * w + i];
            for (int k = 0; k < 9; ++k) {
                // The texel that the sampler finds there; beyond a border the nearest.
                const int x = wrap_index<float>(i + k % 3 - 1, w, job.sampler.wrap_u);
                const int y =
                    wrap_index<float>(j + k / 3 - 1, job.plane.height, job.sampler.wrap_v);
                least = std::min(least, ratios[static_cast<std::size_t>(y) * w + x]);
            }
            texels[(static_cast<std::size_t>(j) * w + i) * 2 + 1] = least;
        }
    });
}

void quantise_ratios(const BakeJob& job, Texture& map) {
    const int bits = job.whole("bits");
    if (bits == 0) return;
    float* const texels = map.level_texels(0, 0);
    const std::size_t count = static_cast<std::size_t>(job.plane.width) * job.plane.height;
    for (std::size_t k = 0; k < count; ++k)
        texels[2 * k + 1] = floor_to_code(std::min(texels[2 * k + 1], 1.0f), bits);
}

std::shared_ptr<Texture> bake_cone(const BakeJob& job) { return all_cones(job, 1); }

std::shared_ptr<Texture> bake_cone_robust(const BakeJob& job) {
    const auto map = all_cones(job, 0.99);
    filter_ratios(job, 0.01, *map);
    quantise_ratios(job, *map);
    return map;
}

}  // namespace quadrel
