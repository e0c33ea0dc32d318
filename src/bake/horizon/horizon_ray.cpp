#include "bake/horizon/horizon_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrel {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Cells of one axis, inclusive; unbounded where the outermost stored cell goes on.
struct CellSpan {
    CellSpan(int cell, const GridAxis& axis, int level) {
        const int stored = HeightPlane::wrap(cell, axis);
        const int begin = stored >> level << level;
        const int end = std::min(begin + (1 << level), axis.count);
        const int at = axis.periodic ? cell - stored : axis.first;
        low = !axis.periodic && begin == 0 ? -everywhere : at + begin;
        high = !axis.periodic && end == axis.count ? everywhere : at + end - 1;
        node = stored >> level;
    }

    static constexpr int everywhere = 1 << 29;
    int low, high, node;
};

/// One axis of the walk through the dual cells. The texel is a corner of the first cell.
struct CellWalk {
    CellWalk(int texel, double texels_per_length)
        : speed(texels_per_length), cell(speed < 0 ? texel - 1 : texel), start(texel) {}

    /// Where the ray leaves a span; from the start and a whole number, never summed up.
    double exit(const CellSpan& span) const {
        if (speed == 0) return never;
        return (speed > 0 ? span.high + 1 - start : start - span.low) / std::abs(speed);
    }
    /// Goes to where the ray is at t, in the span or, if it leaves it there, in the next cell.
    void move(const CellSpan& span, double t) {
        if (exit(span) <= t) {
            cell = speed > 0 ? span.high + 1 : span.low - 1;
        } else if (span.low != span.high && speed != 0) {
            const double at = std::floor(start + speed * t);
            cell = static_cast<int>(std::clamp(at, double(span.low), double(span.high)));
        }
    }
    /// Position in the current cell, [0, 1].
    double inside(double t) const { return std::clamp(start - cell + speed * t, 0.0, 1.0); }

    double speed;
    int cell, start;
};

/// The bilinear patch of a cell: a + b f + c g + d f g.
struct Patch {
    Patch(const HeightPlane& plane, int i, int j)
        : a(plane.texel(i, j)),
          b(plane.texel(i + 1, j) - a),
          c(plane.texel(i, j + 1) - a),
          d(plane.texel(i + 1, j + 1) - a - b - c) {}
    double at(double f, double g) const { return (a + b * f) + (c * g + d * f * g); }

    double a, b, c, d;
};

/// The steepest sight line to the part [from, to] of the ray over one cell.
double steepest(const Patch& patch, const CellWalk& x, const CellWalk& y, double own, double from,
                double to) {
    const auto slope = [&](double t) { return (patch.at(x.inside(t), y.inside(t)) - own) / t; };
    const double bend = patch.d * x.speed * y.speed;
    if (from == 0) {
        // (h(t) - h(0)) / t is linear: the derivative at the start, or the end.
        const double f = x.inside(0), g = y.inside(0);
        const double rise =
            patch.b * x.speed + patch.c * y.speed + patch.d * (f * y.speed + g * x.speed);
        return to > 0 ? std::max(rise, slope(to)) : rise;
    }
    double most = std::max(slope(from), slope(to));
    // h = alpha + beta t + bend t^2 from the start of the ray: extremal where
    // (alpha - own) / t^2 = bend.
    const double f0 = x.start - x.cell, g0 = y.start - y.cell;
    const double alpha = patch.a + patch.b * f0 + patch.c * g0 + patch.d * f0 * g0;
    if (bend < 0 && alpha < own) {
        const double t = std::sqrt((alpha - own) / bend);
        if (t > from && t < to) most = std::max(most, slope(t));
    }
    return most;
}

}  // namespace

double exact_horizon(const HeightPlane& plane, const Grid& cells, const Texture& pyramid,
                     const HorizonRay& ray) {
    const double own = plane.texel(ray.i, ray.j);
    const TextureView& view = pyramid.view();
    CellWalk x(ray.i, ray.along_u), y(ray.j, ray.along_v);
    double most = 0, from = 0;
    for (int level = 0; from < ray.length;) {
        const CellSpan across(x.cell, cells.u, level), down(y.cell, cells.v, level);
        const double greatest =
            view.texels[view.offset[level] + down.node * view.width[level] + across.node];
        const bool below = from > 0 && (greatest - own) / from <= most;
        if (!below && level > 0) {
            --level;
            continue;
        }
        const double to = std::max(from, std::min({x.exit(across), y.exit(down), ray.length}));
        if (!below) {
            const Patch patch(plane, x.cell, y.cell);
            most = std::max(most, steepest(patch, x, y, own, from, to));
        }
        x.move(across, to);
        y.move(down, to);
        from = to;
        if (below && level + 1 < view.levels) ++level;
    }
    return most;
}

double sampled_horizon(const HeightPlane& plane, const HorizonRay& ray, double top) {
    const double own = plane.texel(ray.i, ray.j);
    const double speed = std::max(std::abs(ray.along_u), std::abs(ray.along_v));
    double most = 0;
    for (int n = 1; n <= ray.length * speed; ++n) {
        const double t = n / speed;
        if ((top - own) / t <= most) break;
        const int i = ray.i + static_cast<int>(std::floor(ray.along_u * t + 0.5));
        const int j = ray.j + static_cast<int>(std::floor(ray.along_v * t + 0.5));
        most = std::max(most, (plane.texel(i, j) - own) / t);
    }
    return most;
}

}  // namespace quadrel
