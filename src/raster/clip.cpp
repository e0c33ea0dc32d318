#include "quadrel/raster/clip.hpp"

#include <cmath>

namespace quadrel {
namespace {

using Polygon = ClippedPolygon;

bool finite(const glm::vec4& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

/// Any order that both triangles at an edge agree on will do.
bool comes_first(const glm::dvec4& a, const glm::dvec4& b) {
    for (int i = 0; i < 4; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

/// The point of edge ab where the distance vanishes; distances have opposite signs. Both terms of
/// each sum are kept, so that w stays positive between two positive w.
ClipVertex cut(const ClipVertex& a, double distance_a, const ClipVertex& b, double distance_b) {
    if (comes_first(b.position, a.position)) return cut(b, distance_b, a, distance_a);
    const double t = distance_a / (distance_a - distance_b);
    ClipVertex result;
    for (int i = 0; i < 4; ++i) result.position[i] = (1 - t) * a.position[i] + t * b.position[i];
    for (int i = 0; i < 3; ++i) result.weight[i] = (1 - t) * a.weight[i] + t * b.weight[i];
    return result;
}

/// Sutherland and Hodgman, "Reentrant Polygon Clipping" (1974), for one plane; keeps distance >= 0.
/// `mend` puts a cut vertex exactly on the plane: rounding can leave it far off where the edge's
/// end points are of very different sizes, or at w <= 0.
template <class Distance, class Mend>
bool clip_plane(Polygon& polygon, Distance distance, Mend mend) {
    double d[Polygon::max_vertices];
    bool all_inside = true;
    for (int i = 0; i < polygon.count; ++i) {
        d[i] = distance(polygon.vertex[i].position);
        all_inside = all_inside && d[i] >= 0;
    }
    if (all_inside) return false;
    const Polygon from = polygon;
    polygon.count = 0;
    for (int i = 0; i < from.count; ++i) {
        const int next = i + 1 == from.count ? 0 : i + 1;
        if (d[i] >= 0) polygon.vertex[polygon.count++] = from.vertex[i];
        // A vertex exactly on the plane is kept as it is and needs no cut.
        if ((d[i] < 0 && d[next] > 0) || (d[i] > 0 && d[next] < 0)) {
            ClipVertex vertex = cut(from.vertex[i], d[i], from.vertex[next], d[next]);
            mend(vertex.position);
            polygon.vertex[polygon.count++] = vertex;
        }
    }
    return true;
}

bool clip_depth(Polygon& polygon, Conventions conventions) {
    const bool symmetric = conventions == Conventions::gl;
    const bool near = clip_plane(
        polygon, [=](const glm::dvec4& p) { return symmetric ? p.z + p.w : p.z; },
        [=](glm::dvec4& p) { p.z = symmetric ? -p.w : 0; });
    const bool far = clip_plane(
        polygon, [](const glm::dvec4& p) { return p.w - p.z; }, [](glm::dvec4& p) { p.z = p.w; });
    return near || far;
}

bool clip_w(Polygon& polygon) {
    return clip_plane(
        polygon, [](const glm::dvec4& p) { return p.w - minimum_w; },
        [](glm::dvec4& p) { p.w = minimum_w; });
}

/// One side of the guard band: p[axis] / w on the inner side of `limit`; side is +1 or -1.
bool clip_guard_side(Polygon& polygon, int axis, double side, double limit) {
    return clip_plane(
        polygon, [=](const glm::dvec4& p) { return side * (limit * p.w - p[axis]); },
        [=](glm::dvec4& p) { p[axis] = limit * p.w; });
}

bool clip_guard_band(Polygon& polygon, const Viewport& viewport) {
    const double half[2] = {viewport.width * 0.5, viewport.height * 0.5};
    bool cut_any = false;
    for (int axis = 0; axis < 2; ++axis) {
        // Window coordinate c = (p / w + 1) half, or (1 - p / w) half where y is flipped.
        const bool flip = axis == 1 && viewport.conventions == Conventions::d3d;
        const double reach = guard_band / half[axis], centre = flip ? 1 : -1;
        cut_any |= clip_guard_side(polygon, axis, -1, centre - reach);
        cut_any |= clip_guard_side(polygon, axis, 1, centre + reach);
    }
    return cut_any;
}

Polygon original(const std::array<glm::vec4, 3>& clip) {
    Polygon polygon;
    polygon.count = 3;
    for (int i = 0; i < 3; ++i) {
        polygon.vertex[i].position = glm::dvec4(clip[i]);
        polygon.vertex[i].weight[i] = 1;
    }
    return polygon;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& clip, const Viewport& viewport) {
    Polygon polygon = original(clip);
    if (!finite(clip[0]) || !finite(clip[1]) || !finite(clip[2])) {
        polygon.status = ClipStatus::non_finite;
        polygon.count = 0;
        return polygon;
    }
    bool cut_any = clip_depth(polygon, viewport.conventions);
    cut_any |= clip_w(polygon);
    cut_any |= clip_guard_band(polygon, viewport);
    if (polygon.count < 3) polygon.count = 0;
    polygon.status = polygon.count == 0 ? ClipStatus::outside
                     : cut_any          ? ClipStatus::clipped
                                        : ClipStatus::inside;
    return polygon;
}

std::array<double, 3> window_linear_weights(const ClipVertex& vertex,
                                            const std::array<glm::vec4, 3>& clip) {
    std::array<double, 3> result{};
    for (int i = 0; i < 3; ++i) {
        if (vertex.weight[i] == 1) return vertex.weight;
        result[i] = vertex.weight[i] * double(clip[i].w) / vertex.position.w;
    }
    return result;
}

float weigh(const std::array<double, 3>& weight, float v0, float v1, float v2) {
    const float value[3] = {v0, v1, v2};
    double result = 0;
    bool any = false;
    for (int i = 0; i < 3; ++i) {
        if (weight[i] == 1) return value[i];
        if (weight[i] == 0) continue;
        // The first term stands alone: 0 + (-0) would lose a sign.
        result = any ? result + weight[i] * double(value[i]) : weight[i] * double(value[i]);
        any = true;
    }
    return static_cast<float>(result);
}

}  // namespace quadrel
