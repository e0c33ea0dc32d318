#include "relief/oracle/segments.hpp"

namespace quadrel::oracle {
namespace {

/// Coordinates come rounded to float: a point on a wall may lie on either side of it, and one on
/// top of a block above or below that.
constexpr double float_slack = 0x1p-21;

GridRay ray_up(const Heights& heights, const RayUp& ray, double z) {
    const SamplerState& s = heights.sampler();
    const Grid& grid = heights.grid();
    return {{ray.u, ray.Ku, 0, heights.width(), s.wrap_u, grid.u},
            {ray.v, ray.Kv, 0, heights.height(), s.wrap_v, grid.v},
            {z, 1},
            1 - z};
}

/// The piece at t = 0, up to rounding.
Piece<Interval> first_piece(const Field& field, const Heights& heights, const GridRay& ray) {
    const Index i = ray.x.cells(0).first, j = ray.y.cells(0).first;
    const Corners corners = heights.corners(i, j);
    const bool main = has_main_edge(field.surface, corners);
    Sides sides = 0;
    for (int k = 0; k < line_count(field.surface); ++k) {
        const double f = ray.x.position.start.middle() - static_cast<double>(i);
        const double g = ray.y.position.start.middle() - static_cast<double>(j);
        if (line(field.surface, main, k, f, g) >= 0) sides |= 1u << k;
    }
    return piece_of<Interval>(field.surface, corners, i, j, sides);
}

/// Height of the point that the ray starts from.
double start_height(const Field& field, const Heights& heights, const RayUp& ray) {
    const GridRay at = ray_up(heights, ray, 0);
    const Piece<Interval> piece = first_piece(field, heights, at);
    const double height = PieceRay(at, piece).above(0).middle();
    if (field.surface != Surface::block) return height;
    return std::fabs(height - ray.z) <= float_slack ? height : ray.z;
}

/// F above 0 somewhere, beyond doubt. `on_surface`: F is 0 where the segment begins.
bool is_above(const GridRay& ray, const Segment& segment, bool on_surface) {
    const PieceRay along(ray, segment.pieces[0]);
    const double from = segment.from, to = segment.to;
    const double slope = along.slope(from).middle(), bend = along.curvature().middle();
    if (on_surface) return slope > 0 || slope + bend * (to - from) > 0;
    if (along.above(from).lo > 0 || along.above(to).lo > 0) return true;
    const double peak = from - slope / (2 * bend);
    return bend < 0 && peak > from && peak < to && along.above(peak).lo > 0;
}

/// How far along the ray its start may be from where it is.
double rounded_start(const GridRay& ray) {
    const auto axis = [](const RayAxis& a) {
        const double rate = a.position.rate.magnitude();
        return rate > 0 ? float_slack * (1 + a.position.start.magnitude()) / rate : 1;
    };
    return std::min(axis(ray.x), axis(ray.y));
}

}  // namespace

bool is_occluded(const Field& field, const RayUp& up_ray, std::int32_t& steps) {
    const Heights heights(field);
    const GridRay plane = ray_up(heights, up_ray, 0);
    if (!plane.is_finite() || plane.is_too_long()) return false;
    const GridRay ray = ray_up(heights, up_ray, start_height(field, heights, up_ray));
    if (!(ray.end > 0)) return false;
    const bool blocks = field.surface == Surface::block;
    const double begin = blocks ? rounded_start(ray) : 0;
    CellWalk walk(heights, ray);
    const WalkEnd end = walk.run([&](const Part& part) {
        CellSegments segments(field.surface, heights, ray, part);
        if (!segments.finite()) return false;
        return segments.each([&](const Segment& segment) {
            // Over borders the segments before and behind tell as much.
            if (segment.count != 1 || segment.to <= begin) return false;
            return is_above(ray, segment, segment.from == 0 && !blocks);
        });
    });
    steps += walk.steps;
    return end == WalkEnd::stopped;
}

}  // namespace quadrel::oracle
