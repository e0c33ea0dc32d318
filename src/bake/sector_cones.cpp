// Cones with a ratio for each sector of directions.
//
// quad-cone. Source: Policarpo, Oliveira, GPU Gems 3, chapter 18 (its demonstration): four sectors,
// -u +u -v +v, by the greater component of the offset in tile units, v on a tie. A texel counts for
// the sector that its centre is in.
// aniso-cone: eight sectors of 45 degrees, the k-th from azimuth 45 k to 45 (k + 1), counted from
// +u towards +v in tile units. A texel counts for every sector that its square touches, so that no
// ray of a sector passes over a texel that did not count. Inspired by Chen, Chuang, "Anisotropic
// Relaxed Cone Stepping", APSIPA 2009.
#include "bake/cone.hpp"
#include "bake/generators.hpp"

namespace quadrel {

namespace {

struct Interval {
    double low, high;
    Interval operator-() const { return {-high, -low}; }
};

/// Whether the rectangle x, y touches the wedge 0 <= y <= x.
bool touches_first_octant(const Interval& x, const Interval& y) {
    return y.high >= 0 && x.high >= std::max(y.low, 0.0);
}

/// Whether it touches octant k: the first octant of mirrored axes.
bool touches_octant(int k, const Interval& x, const Interval& y) {
    switch (k) {
        case 0:
            return touches_first_octant(x, y);
        case 1:
            return touches_first_octant(y, x);
        case 2:
            return touches_first_octant(y, -x);
        case 3:
            return touches_first_octant(-x, y);
        case 4:
            return touches_first_octant(-x, -y);
        case 5:
            return touches_first_octant(-y, -x);
        case 6:
            return touches_first_octant(-y, x);
        default:
            return touches_first_octant(x, -y);
    }
}

/// Bit k: the texel at an offset counts for sector k.
unsigned octants_of(const HeightPlane& plane, int di, int dj) {
    const Interval x{(di - 0.5) / plane.width, (di + 0.5) / plane.width};
    const Interval y{(dj - 0.5) / plane.height, (dj + 0.5) / plane.height};
    unsigned sectors = 0;
    for (int k = 0; k < 8; ++k) sectors |= touches_octant(k, x, y) ? 1u << k : 0u;
    return sectors;
}

unsigned quadrant_of(const HeightPlane& plane, int di, int dj) {
    const bool along_u = std::abs(di) * static_cast<std::int64_t>(plane.height) >
                         std::abs(dj) * static_cast<std::int64_t>(plane.width);
    if (along_u) return di < 0 ? 1u : 2u;
    return dj < 0 ? 4u : 8u;
}

/// The least ratio of each sector. `sectors_of(plane, di, dj)` as bits.
template <int sectors, class SectorsOf>
std::array<double, sectors> sector_ratios(const HeightPlane& plane, const Apex& apex, double top,
                                          double limit, const SectorsOf& sectors_of) {
    const TileMetric metric(plane.width, plane.height);
    std::array<double, sectors> best;
    best.fill(limit);
    double widest = limit;
    search_rings(
        apex.u, apex.v,
        [&](int r) {
            return top <= apex.height || cone_ratio(metric.ring(r), top - apex.height) >= widest;
        },
        [&](int di, int dj) {
            const double rise = plane.at(apex.u.at(di), apex.v.at(dj)) - apex.height;
            if (!(rise > 0)) return;
            const double ratio = cone_ratio(metric(di, dj), rise);
            if (ratio >= widest) return;
            const unsigned hit = sectors_of(plane, di, dj);
            for (int k = 0; k < sectors; ++k)
                if (hit >> k & 1u) best[k] = std::min(best[k], ratio);
            widest = *std::max_element(best.begin(), best.end());
        });
    return best;
}

/// Layers of four ratios.
template <int sectors, class SectorsOf>
std::shared_ptr<Texture> make_sector_map(const BakeJob& job, const SectorsOf& sectors_of) {
    const HeightPlane& plane = job.plane;
    const auto map = job.make(4, sectors / 4, {{plane.width, plane.height}});
    const double top = highest(plane), limit = job.parameter("c_max");
    const std::size_t layer = static_cast<std::size_t>(plane.width) * plane.height * 4;
    for_each_apex(job, 1, Images::all, *map, [&](const Apex& apex, float* texel) {
        const auto ratios = sector_ratios<sectors>(plane, apex, top, limit, sectors_of);
        for (int k = 0; k < sectors; ++k) {
            texel[static_cast<std::size_t>(k / 4) * layer + k % 4] = safe_ratio(ratios[k], limit);
        }
    });
    return map;
}

}  // namespace

std::shared_ptr<Texture> bake_quad_cone(const BakeJob& job) {
    return make_sector_map<4>(job, quadrant_of);
}

std::shared_ptr<Texture> bake_aniso_cone(const BakeJob& job) {
    return make_sector_map<8>(job, octants_of);
}

}  // namespace quadrel
