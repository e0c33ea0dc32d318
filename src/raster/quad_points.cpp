#include "quadrel/raster/quad_points.hpp"

#include <bit>
#include <cmath>

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

/// An edge function at the pixel centres of a quad, and its step to the next quad.
struct EdgeRun {
    std::int64_t lane[4];
    std::int64_t step;
};

EdgeRun edge_run(const EdgeFunction& edge, int x, int y) {
    const Point centre = in_pixel(x, y, SamplePosition{});
    const std::int64_t first = edge(centre.x, centre.y);
    const std::int64_t right = edge.a * subpixel_units, up = edge.b * subpixel_units;
    return {{first, first + right, first + up, first + right + up}, 2 * right};
}

/// Whether all values of so many quads are whole numbers that double has: then sums of them are
/// exact.
bool fits_double(const EdgeRun& run, int quads) {
    const double reach = std::abs(static_cast<double>(run.step)) * quads;
    for (const std::int64_t lane : run.lane)
        if (std::abs(static_cast<double>(lane)) + reach >= 0x1p52) return false;
    return true;
}

/// T is double where all values fit, for which there are wide instructions; else std::int64_t.
template <class T>
void step_edges(const EdgeRun& run, int quads, double* out) {
    const T step = static_cast<T>(run.step);
    T first[4];
    for (int k = 0; k < 4; ++k) first[k] = static_cast<T>(run.lane[k]);
    for (int q = 0; q < quads; ++q, out += 4) {
        const T way = static_cast<T>(q) * step;
        for (int k = 0; k < 4; ++k) out[k] = static_cast<double>(first[k] + way);
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

void attribute_edges(const ScreenTriangle& triangle, int x, int y, int quads, double* e0,
                     double* e1, double* e2) {
    double* const out[3] = {e0, e1, e2};
    for (int i = 0; i < 3; ++i) {
        const EdgeRun run = edge_run(triangle.edge[i], x, y);
        if (fits_double(run, quads))
            step_edges<double>(run, quads, out[i]);
        else
            step_edges<std::int64_t>(run, quads, out[i]);
    }
}

EdgeSlopes edge_slopes(const ScreenTriangle& triangle) {
    EdgeSlopes slopes;
    for (std::size_t i = 0; i < 3; ++i) {
        slopes.dx[i] = static_cast<double>(triangle.edge[i].a) * subpixel_units;
        slopes.dy[i] = static_cast<double>(triangle.edge[i].b) * subpixel_units;
    }
    return slopes;
}

}  // namespace quadrel
