#include "quadrel/raster/quad_points.hpp"

#include <bit>

#include "quadrel/raster/samples.hpp"

namespace quadrel {
namespace {

struct Point {
    std::int32_t x, y;
};

Point in_pixel(int x, int y, SamplePosition position) {
    return {x * subpixel_units + position.x * 16, y * subpixel_units + position.y * 16};
}

Point centroid(const ScreenTriangle& triangle, int x, int y, int samples) {
    const std::uint32_t mask = coverage_mask(triangle, x, y, samples);
    const std::uint32_t all = (1u << samples) - 1;
    if (mask == 0 || mask == all) return in_pixel(x, y, SamplePosition{});
    return in_pixel(x, y, sample_positions(samples)[std::countr_zero(mask)]);
}

template <class T>
void snapped_edges(const ScreenTriangle& triangle, const QuadPoints& points, T* const* out) {
    for (int i = 0; i < 3; ++i) {
        const EdgeFunction edge = triangle.edge[i];
        T lanes[4];
        for (int k = 0; k < 4; ++k) lanes[k] = static_cast<T>(edge(points.x[k], points.y[k]));
        for (int k = 0; k < 4; ++k) out[i][k] = lanes[k];
    }
}

template <class Place>
QuadPoints for_lanes(int x, int y, Place place) {
    QuadPoints points;
    for (int lane = 0; lane < 4; ++lane) {
        const Point point = place(x + (lane & 1), y + (lane >> 1));
        points.x[lane] = point.x;
        points.y[lane] = point.y;
    }
    return points;
}

}  // namespace

QuadPoints quad_centres(int x, int y) {
    return for_lanes(x, y, [](int px, int py) { return in_pixel(px, py, SamplePosition{}); });
}

QuadPoints quad_centroids(const ScreenTriangle& triangle, int x, int y, int samples) {
    return for_lanes(x, y, [&](int px, int py) { return centroid(triangle, px, py, samples); });
}

QuadEdges edge_values(const ScreenTriangle& triangle, const QuadPoints& points) {
    QuadEdges edges;
    std::int64_t* const out[3] = {edges[0].data(), edges[1].data(), edges[2].data()};
    snapped_edges(triangle, points, out);
    return edges;
}

void attribute_edges(const ScreenTriangle& triangle, const QuadPoints& points, double* e0,
                     double* e1, double* e2) {
    double* const out[3] = {e0, e1, e2};
    snapped_edges(triangle, points, out);
}

}  // namespace quadrel
