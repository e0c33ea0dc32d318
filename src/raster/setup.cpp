#include "quadrel/raster/setup.hpp"

#include <algorithm>
#include <cmath>

namespace quadrel {
namespace {

/// As a vertex pipeline in float32 has it (Mesa's draw module): the divide, then one fused
/// multiply-add.
void set_float_position(const glm::dvec4& clip, const Viewport& viewport, ScreenVertex& vertex) {
    const float inverse_w = 1.0f / static_cast<float>(clip.w);
    const float half_width = viewport.width * 0.5f, half_height = viewport.height * 0.5f;
    const float y_scale = viewport.conventions == Conventions::d3d ? -half_height : half_height;
    vertex.clip_y = static_cast<float>(clip.y);
    vertex.window_x = std::fma(static_cast<float>(clip.x) * inverse_w, half_width, half_width);
    vertex.window_y = std::fma(vertex.clip_y * inverse_w, y_scale, half_height);
}

/// The edge from p to q, positive to its left where x turns left to y; `sign` turns it around.
EdgeFunction edge_function(const ScreenVertex& p, const ScreenVertex& q, std::int64_t sign) {
    EdgeFunction edge;
    edge.a = sign * (std::int64_t(p.y) - q.y);
    edge.b = sign * (std::int64_t(q.x) - p.x);
    edge.c = -(edge.a * p.x + edge.b * p.y);
    const bool included = edge.a > 0 || (edge.a == 0 && edge.b > 0);
    edge.threshold = included ? 0 : 1;
    return edge;
}

void set_edges(ScreenTriangle& triangle, std::int64_t sign) {
    const auto& v = triangle.vertex;
    for (int i = 0; i < 3; ++i)
        triangle.edge[i] = edge_function(v[(i + 1) % 3], v[(i + 2) % 3], sign);
}

PixelRect pixel_bounds(const std::array<ScreenVertex, 3>& v) {
    const auto [x0, x1] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [y0, y1] = std::minmax({v[0].y, v[1].y, v[2].y});
    // Arithmetic shifts are floors: a pixel holds the points [i, i+1).
    return {x0 >> 8, y0 >> 8, (x1 >> 8) + 1, (y1 >> 8) + 1};
}

bool is_front(std::int64_t area2, Conventions conventions) {
    const bool y_up = conventions == Conventions::gl;
    return y_up ? area2 > 0 : area2 < 0;
}

bool is_culled(bool front, Cull cull) {
    return (cull == Cull::back && !front) || (cull == Cull::front && front);
}

}  // namespace

ScreenVertex screen_vertex(const glm::dvec4& clip, const RasterState& state) {
    const WindowPoint point = to_window(state.viewport, clip);
    ScreenVertex vertex;
    vertex.x = snap(point.x, state.subpixel_bits, state.snap_rounding);
    vertex.y = snap(point.y, state.subpixel_bits, state.snap_rounding);
    set_float_position(clip, state.viewport, vertex);
    vertex.depth = point.z;
    vertex.w = static_cast<float>(clip.w);
    return vertex;
}

std::int64_t signed_area2(const std::array<ScreenVertex, 3>& v) {
    const std::int64_t x1 = v[1].x - v[0].x, y1 = v[1].y - v[0].y;
    const std::int64_t x2 = v[2].x - v[0].x, y2 = v[2].y - v[0].y;
    return x1 * y2 - x2 * y1;
}

RasterState raster_state(const Viewport& viewport, const HardwareModel& hardware, Cull cull) {
    return {viewport, hardware.subpixel_bits, hardware.snap_rounding, cull};
}

SetupOutcome set_up_triangle(const std::array<glm::dvec4, 3>& clip, const RasterState& state,
                             ScreenTriangle& triangle) {
    for (int i = 0; i < 3; ++i) triangle.vertex[i] = screen_vertex(clip[i], state);
    const std::int64_t area2 = signed_area2(triangle.vertex);
    if (area2 == 0) return SetupOutcome::zero_area;
    triangle.front_facing = is_front(area2, state.viewport.conventions);
    if (is_culled(triangle.front_facing, state.cull)) return SetupOutcome::culled;
    triangle.bounds = intersect(pixel_bounds(triangle.vertex), frame_rect(state.viewport));
    if (triangle.bounds.empty()) return SetupOutcome::off_frame;

    triangle.area2 = area2 < 0 ? -area2 : area2;
    set_edges(triangle, area2 < 0 ? -1 : 1);
    const double area = static_cast<double>(triangle.area2);
    const auto& v = triangle.vertex;
    triangle.depth1 = (v[1].depth - v[0].depth) / area;
    triangle.depth2 = (v[2].depth - v[0].depth) / area;
    return SetupOutcome::drawn;
}

float depth_at(const ScreenTriangle& triangle, std::int64_t x, std::int64_t y) {
    const double e1 = static_cast<double>(triangle.edge[1](x, y));
    const double e2 = static_cast<double>(triangle.edge[2](x, y));
    const double depth = triangle.vertex[0].depth + (e1 * triangle.depth1 + e2 * triangle.depth2);
    return static_cast<float>(depth < 0 ? 0 : depth > 1 ? 1 : depth);
}

}  // namespace quadrel
