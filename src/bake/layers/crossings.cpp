#include "bake/layers/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quadrel {
namespace {

/// Products of positions need more than 64 bits: maps are up to 2^14 texels, rounded to 2^-24.
__extension__ using Wide = __int128;

constexpr double units = 0x1p24;  ///< a texel
constexpr std::int64_t half = std::int64_t(1) << 23;

struct Point {
    std::int64_t x, y;
};

Point rounded(const glm::dvec3& p) {
    return {static_cast<std::int64_t>(std::llround(p.x * units)),
            static_cast<std::int64_t>(std::llround(p.y * units))};
}

/// Twice the area of the triangle a, b, p: above 0 where p is to the left of the way from a to b.
Wide area(const Point& a, const Point& b, const Point& p) {
    return Wide(b.x - a.x) * (p.y - a.y) - Wide(b.y - a.y) * (p.x - a.x);
}

/// Whether p is to the left, or on the line where moving it by (e, e^2) would bring it there.
bool is_left(const Point& a, const Point& b, Wide area) {
    if (area != 0) return area > 0;
    return b.y != a.y ? b.y < a.y : b.x > a.x;
}

/// A triangle, its corners counter-clockwise in the map.
struct Facet {
    std::array<Point, 3> corners;
    std::array<double, 3> depths;
    Wide area;
    int winding;
};

/// Crosses the facet at p, if it does.
void add_crossing(const Facet& facet, const Point& p, std::vector<Crossing>& crossings) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Point &a = facet.corners[(k + 1) % 3], &b = facet.corners[(k + 2) % 3];
        const Wide part = area(a, b, p);
        if (!is_left(a, b, part)) return;
        weights[k] = static_cast<double>(part) / static_cast<double>(facet.area);
    }
    const double depth =
        weights[0] * facet.depths[0] + weights[1] * facet.depths[1] + weights[2] * facet.depths[2];
    crossings.push_back({depth, facet.winding});
}

/// First texel whose centre is not before a position, and that after the last one not behind it.
int first_texel(std::int64_t position, int size) {
    const std::int64_t texel = (position - half + 2 * half - 1) >> 24;
    return static_cast<int>(std::clamp<std::int64_t>(texel, 0, size));
}
int end_texel(std::int64_t position, int size) {
    const std::int64_t texel = ((position - half) >> 24) + 1;
    return static_cast<int>(std::clamp<std::int64_t>(texel, 0, size));
}

}  // namespace

std::vector<std::vector<Crossing>> texel_crossings(const ProjectedMesh& mesh, int width, int height,
                                                   const std::function<void(double)>& progress) {
    std::vector<std::vector<Crossing>> texels(static_cast<std::size_t>(width) * height);
    constexpr double found = 0.75;  // of the time; then they are sorted
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& triangle = mesh.triangles[t];
        Facet facet{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.positions[triangle[k]];
            facet.corners[k] = rounded(p);
            facet.depths[k] = p.z;
        }
        facet.area = area(facet.corners[0], facet.corners[1], facet.corners[2]);
        if (facet.area == 0) continue;  // seen along its plane
        facet.winding = facet.area > 0 ? 1 : -1;
        if (facet.area < 0) {
            std::swap(facet.corners[1], facet.corners[2]);
            std::swap(facet.depths[1], facet.depths[2]);
            facet.area = -facet.area;
        }
        const auto& [a, b, c] = facet.corners;
        const auto [left, right] = std::minmax({a.x, b.x, c.x});
        const auto [low, high] = std::minmax({a.y, b.y, c.y});
        const int first_row = first_texel(low, height), end_row = end_texel(high, height);
        for (int j = first_row; j < end_row; ++j) {
            const double rows = static_cast<double>(j - first_row) / (end_row - first_row);
            progress(found * (static_cast<double>(t) + rows) /
                     static_cast<double>(mesh.triangles.size()));
            for (int i = first_texel(left, width); i < end_texel(right, width); ++i) {
                const Point centre{(std::int64_t(i) << 24) + half, (std::int64_t(j) << 24) + half};
                add_crossing(facet, centre, texels[static_cast<std::size_t>(j) * width + i]);
            }
        }
    }
    for (std::size_t t = 0; t < texels.size(); ++t) {
        if (t % static_cast<std::size_t>(width) == 0)
            progress(found +
                     (1 - found) * static_cast<double>(t) / static_cast<double>(texels.size()));
        std::stable_sort(texels[t].begin(), texels[t].end(),
                         [](const Crossing& x, const Crossing& y) { return x.depth < y.depth; });
    }
    return texels;
}

}  // namespace quadrel
