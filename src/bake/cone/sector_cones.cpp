// Cones with a ratio for each sector of directions.
//
// quad-cone. Source: Policarpo, Oliveira, GPU Gems 3, chapter 18 (its demonstration): four sectors,
// -u +u -v +v, by the greater component of the offset in tile units, v on a tie. A texel counts for
// the sector that its centre is in.
// aniso-cone: eight sectors of 45 degrees, the k-th from azimuth 45 k to 45 (k + 1), counted from
// +u towards +v in tile units. A texel counts for every sector that its square touches, so that no
// ray of a sector passes over a texel that did not count. Inspired by Chen, Chuang, "Anisotropic
// Relaxed Cone Stepping", APSIPA 2009.
#include "bake/generators.hpp"
#include "bake/search/octants.hpp"
#include "bake/search/sector_search.hpp"

namespace quadrel {

namespace {

struct Quadrants {
    static constexpr int sectors = 4, channels = 1;

    explicit Quadrants(const HeightPlane& plane) : width(plane.width), height(plane.height) {}

    /// Along v where the offsets along u are no greater, in tile units: exact, in whole numbers.
    unsigned sectors_of(const Offsets& at) const {
        const std::int64_t least_u = at.gap_u() * height, least_v = at.gap_v() * width;
        const std::int64_t most_u = std::max(-at.u_low, at.u_high) * height;
        const std::int64_t most_v = std::max(-at.v_low, at.v_high) * width;
        unsigned hit = 0;
        if (most_u > least_v) hit |= (at.u_low < 0 ? 1u : 0u) | (at.u_high > 0 ? 2u : 0u);
        if (least_u <= most_v) hit |= (at.v_low < 0 ? 4u : 0u) | (at.v_high > 0 ? 8u : 0u);
        return hit;
    }
    float greatest(const Offsets&, const float* channel) const { return *channel; }

    std::int64_t width, height;
};

struct Octants {
    static constexpr int sectors = 8, channels = 1;

    explicit Octants(const HeightPlane& plane) : width(plane.width), height(plane.height) {}

    unsigned sectors_of(const Offsets& at) const {
        return octants_of({(at.u_low - 0.5) / width, (at.u_high + 0.5) / width},
                          {(at.v_low - 0.5) / height, (at.v_high + 0.5) / height});
    }
    float greatest(const Offsets&, const float* channel) const { return *channel; }

    int width, height;
};

/// Layers of four ratios.
template <class Directions>
std::shared_ptr<Texture> make_sector_map(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const auto map = job.make(4, Directions::sectors / 4, {{plane.width, plane.height}});
    const double limit = job.parameter("c_max");
    const std::size_t layer = static_cast<std::size_t>(plane.width) * plane.height * 4;
    const PlaneTree tree(job, 0.01, 1, cone_reach(plane, limit),
                         [&](int x, int y, int) { return plane.at(x, y); });
    const Directions directions(plane);
    const TileMetric metric(plane.width, plane.height);
    SectorSearch shared(tree, directions, metric, limit);
    for_each_apex(job, 0.99, *map, [shared, layer, limit](const Apex& apex, float* texel) mutable {
        const auto ratios = shared(apex);
        for (std::size_t k = 0; k < ratios.size(); ++k)
            texel[k / 4 * layer + k % 4] = safe_ratio(ratios[k], limit);
    });
    return map;
}

}  // namespace

std::shared_ptr<Texture> bake_quad_cone(const BakeJob& job) {
    return make_sector_map<Quadrants>(job);
}

std::shared_ptr<Texture> bake_aniso_cone(const BakeJob& job) {
    return make_sector_map<Octants>(job);
}

}  // namespace quadrel
