#include "bake/horizon_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrel {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// One axis of the walk through the dual cells. The texel is a corner of the first cell.
struct CellWalk {
    CellWalk(int texel, double texels_per_length)
        : speed(texels_per_length), cell(speed < 0 ? texel - 1 : texel), start(texel) {}

    /// Where the ray leaves the current cell; from the start and a whole number, never summed up.
    double exit() const {
        if (speed == 0) return never;
        return (speed > 0 ? cell + 1 - start : start - cell) / std::abs(speed);
    }
    void next() { cell += speed > 0 ? 1 : -1; }
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

double exact_horizon(const HeightPlane& plane, const HorizonRay& ray, double top) {
    const double own = plane.texel(ray.i, ray.j);
    CellWalk x(ray.i, ray.along_u), y(ray.j, ray.along_v);
    double most = 0, from = 0;
    while (from < ray.length && (from == 0 || (top - own) / from > most)) {
        const double exit_x = x.exit(), exit_y = y.exit();
        const double to = std::min({exit_x, exit_y, ray.length});
        most = std::max(most, steepest(Patch(plane, x.cell, y.cell), x, y, own, from, to));
        if (exit_x <= to) x.next();
        if (exit_y <= to) y.next();
        from = to;
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
