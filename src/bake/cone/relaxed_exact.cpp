// Relaxed cone maps by falling edges. Source: Ban, Valasek, Balint, Vad, "Robust Cone Step
// Mapping", EGSR 2024: a ray that has gone below the field inside of a cone can only come out where
// the field falls going away from the apex, so only texels at the start of such an edge bound the
// cone; then the 3x3 minimum. Differs in distances in tile units and in rounding down.
#include "bake/generators.hpp"
#include "bake/search/sector_search.hpp"

namespace quadrel {

namespace {

/// Whether the cell from texel (x, y) away in direction (sx, sy) has an edge that falls outwards.
bool falls(const HeightPlane& plane, int x, int y, int sx, int sy) {
    const int x1 = HeightPlane::wrap_step(x + sx, plane.grid.u);
    const int y1 = HeightPlane::wrap_step(y + sy, plane.grid.v);
    const float near = plane.at(x, y), along_u = plane.at(x1, y), along_v = plane.at(x, y1);
    const float far = plane.at(x1, y1);
    return near > along_u || near > along_v || along_u > far || along_v > far;
}

/// The quadrants of directions, (-u, -v) first, then (+u, -v): a channel each, which holds the
/// texels that the field falls behind, seen along it. On an axis the cells on both sides are
/// behind.
struct FallingEdges {
    static constexpr int sectors = 1, channels = 4;
    static constexpr float none = -std::numeric_limits<float>::infinity();

    static float value(const HeightPlane& plane, int x, int y, int quadrant) {
        const int sx = quadrant % 2 ? 1 : -1, sy = quadrant / 2 ? 1 : -1;
        return falls(plane, x, y, sx, sy) ? plane.at(x, y) : none;
    }
    unsigned sectors_of(const Offsets&) const { return 1; }
    float greatest(const Offsets& at, const float* channel) const {
        float most = none;
        for (int k = 0; k < channels; ++k) {
            const bool along_u = k % 2 ? at.u_high >= 0 : at.u_low <= 0;
            const bool along_v = k / 2 ? at.v_high >= 0 : at.v_low <= 0;
            if (along_u && along_v) most = std::max(most, channel[k]);
        }
        return most;
    }
};

}  // namespace

std::shared_ptr<Texture> bake_relaxed_cone_exact(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const double limit = job.parameter("c_max");
    const PlaneTree tree(job, 0.01, FallingEdges::channels, cone_reach(plane, limit),
                         [&](int x, int y, int c) { return FallingEdges::value(plane, x, y, c); });
    const FallingEdges directions;
    const TileMetric metric(plane.width, plane.height);
    const auto map =
        make_cone_map(job, 0.98,
                      [limit, search = SectorSearch(tree, directions, metric, limit)](
                          const Apex& apex) mutable { return safe_ratio(search(apex)[0], limit); });
    filter_ratios(job, 0.01, *map);
    quantise_ratios(job, *map);
    return map;
}

}  // namespace quadrel
