// Conservative cone maps by brute force. Source: Dummer, "Cone Step Mapping: An Iterative
// Ray-Heightfield Intersection Algorithm", 2006. Differs in measuring distances in the units of the
// tile on both axes, so that maps that are not square are right, and in rounding down. The robust
// map adds the 3x3 minimum and the rounding of Ban, Valasek, Balint, Vad, "Robust Cone Step
// Mapping", EGSR 2024.
#include "bake/cone.hpp"

#include "bake/generators.hpp"

namespace quadrel {

namespace {

/// The least ratio that any higher texel imposes on the cone of `apex`.
double least_ratio(const HeightPlane& plane, const TileMetric& metric, const Apex& apex, double top,
                   double limit) {
    double best = limit;
    if (top <= apex.height) return best;
    search_rings(
        apex.u, apex.v,
        [&](int r) { return cone_ratio(metric.ring(r), top - apex.height) >= best; },
        [&](int di, int dj) {
            const double rise = plane.at(apex.u.at(di), apex.v.at(dj)) - apex.height;
            if (rise > 0) best = std::min(best, cone_ratio(metric(di, dj), rise));
        });
    return best;
}

std::shared_ptr<Texture> brute_force_cones(const BakeJob& job, double share) {
    const HeightPlane& plane = job.plane;
    const TileMetric metric(plane.width, plane.height);
    const double top = highest(plane), limit = job.parameter("c_max");
    return make_cone_map(job, share, Images::nearest, [&](const Apex& apex) {
        return safe_ratio(least_ratio(plane, metric, apex, top, limit), limit);
    });
}

}  // namespace

float highest(const HeightPlane& plane) {
    return *std::max_element(plane.heights.begin(), plane.heights.end());
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

std::shared_ptr<Texture> bake_cone(const BakeJob& job) { return brute_force_cones(job, 1); }

std::shared_ptr<Texture> bake_cone_robust(const BakeJob& job) {
    const auto map = brute_force_cones(job, 0.99);
    filter_ratios(job, 0.01, *map);
    quantise_ratios(job, *map);
    return map;
}

}  // namespace quadrel
