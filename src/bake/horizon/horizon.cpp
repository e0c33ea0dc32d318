// Horizon maps: layer k holds the tangent of the horizon's elevation towards azimuth 360 k / A
// degrees, counted from +u towards +v in tile units, for heights of the same unit; the tangent for
// a relief of depth D tiles is D times that. Never below 0, since the field never ends. Source:
// Max, "Horizon mapping: shadows for bump-mapped surfaces", The Visual Computer 4, 1988.
//
// horizon: along the ray from a texel's centre the bilinear field is a parabola in every dual cell
// that the ray crosses, and the steepest sight line to it is found exactly; rounded up.
// horizon-sampled: the nearest texel at every texel's length of the ray, as Max does.
#include "bake/generators.hpp"
#include "bake/horizon/horizon_ray.hpp"
#include "bake/pyramid/pyramid.hpp"
#include "bake/rounding.hpp"
#include "scene/degrees.hpp"

namespace quadrel {

namespace {

struct Direction {
    double u, v;
};

/// Exact on the axes, symmetrical on the diagonals.
Direction direction_of(int k, int azimuths) {
    constexpr double diagonal = 0.70710678118654752440;
    static constexpr Direction eight[] = {
        {1, 0},  {diagonal, diagonal},   {0, 1},  {-diagonal, diagonal},
        {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}};
    if (8 * k % azimuths == 0) return eight[8 * k / azimuths];
    const SinCos turn = sin_cos_degrees(360.0 * k / azimuths);
    return {turn.cosine, turn.sine};
}

/// How far a ray has to be followed. Towards the eight main azimuths the field repeats within the
/// sum of its extents on both axes, or is constant from there on; towards the others `reach`
/// decides.
double ray_length(const BakeJob& job, int k, int azimuths) {
    const HeightPlane& plane = job.plane;
    const double tiles =
        (plane.grid.u.count + 2.0) / plane.width + (plane.grid.v.count + 2.0) / plane.height;
    const double once = tiles * 1.4142135623730951;
    return 8 * k % azimuths == 0 ? once : std::max(once, job.parameter("reach"));
}

template <class Slope>
std::shared_ptr<Texture> make_horizons(const BakeJob& job, const Slope& slope) {
    const HeightPlane& plane = job.plane;
    const int azimuths = job.whole("azimuths");
    const auto map = job.make(1, azimuths, {{plane.width, plane.height}});
    for (int k = 0; k < azimuths; ++k) {
        const Direction to = direction_of(k, azimuths);
        const double length = ray_length(job, k, azimuths);
        float* const texels = map->level_texels(0, k);
        job.rows(plane.height, 1.0 / azimuths, [&](int j) {
            float* out = texels + static_cast<std::size_t>(j) * plane.width;
            for (int i = 0; i < plane.width; ++i)
                *out++ = slope(HorizonRay{i, j, to.u * plane.width, to.v * plane.height, length});
        });
    }
    return map;
}

float highest_of(const HeightPlane& plane) {
    return *std::max_element(plane.heights.begin(), plane.heights.end());
}

}  // namespace

std::shared_ptr<Texture> bake_horizon(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const Grid cells = cell_grid(plane.width, plane.height, job.sampler);
    const auto pyramid = cell_max_pyramid(job, 0.01);
    return make_horizons(job, [&](const HorizonRay& ray) {
        const double slope = exact_horizon(plane, cells, *pyramid, ray);
        return slope > 0 ? round_up(slope * (1 + 0x1p-40)) : 0;
    });
}

std::shared_ptr<Texture> bake_horizon_sampled(const BakeJob& job) {
    const double top = highest_of(job.plane);
    return make_horizons(job, [&](const HorizonRay& ray) {
        return static_cast<float>(sampled_horizon(job.plane, ray, top));
    });
}

}  // namespace quadrel
