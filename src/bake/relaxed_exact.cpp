// Relaxed cone maps by falling edges. Source: Ban, Valasek, Balint, Vad, "Robust Cone Step
// Mapping", EGSR 2024: a ray that has gone below the field inside of a cone can only come out where
// the field falls going away from the apex, so only texels at the start of such an edge bound the
// cone; then the 3x3 minimum. Differs in distances in tile units and in rounding down.
#include "bake/cone.hpp"
#include "bake/generators.hpp"

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

/// Whether the field falls behind texel (x, y), seen from an apex (di, dj) away from it. On an axis
/// the cells on both sides are behind it.
bool is_limiting(const HeightPlane& plane, int x, int y, int di, int dj) {
    for (const int sx : {-1, 1}) {
        for (const int sy : {-1, 1}) {
            if (di * sx < 0 || dj * sy < 0) continue;
            if (falls(plane, x, y, sx, sy)) return true;
        }
    }
    return false;
}

}  // namespace

std::shared_ptr<Texture> bake_relaxed_cone_exact(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const TileMetric metric(plane.width, plane.height);
    const double top = highest(plane), limit = job.parameter("c_max");
    const auto ratio = [&](const Apex& apex) {
        double best = limit;
        if (top <= apex.height) return safe_ratio(best, limit);
        search_rings(
            apex.u, apex.v,
            [&](int r) { return cone_ratio(metric.ring(r), top - apex.height) >= best; },
            [&](int di, int dj) {
                const int x = apex.u.at(di), y = apex.v.at(dj);
                const double rise = plane.at(x, y) - apex.height;
                if (!(rise > 0)) return;
                const double reached = cone_ratio(metric(di, dj), rise);
                if (reached < best && is_limiting(plane, x, y, di, dj)) best = reached;
            });
        return safe_ratio(best, limit);
    };
    const auto map = make_cone_map(job, 0.99, Images::all, ratio);
    filter_ratios(job, 0.01, *map);
    quantise_ratios(job, *map);
    return map;
}

}  // namespace quadrel
