#include "bake/direction/relief_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrel {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The least root above 0 of a t^2 + b t + c.
double least_root(double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) return never;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    double least = never;
    for (const double root : {q / a, c / q})
        if (root > 0 && root < least) least = root;
    return least;
}

/// One axis of the walk.
struct Walk {
    double start, rate;
    int cell;

    Walk(double from, double by) : start(from), rate(by), cell(static_cast<int>(std::floor(from))) {
        // On a border, into the cell that the ray goes to.
        if (rate < 0 && start == cell) --cell;
    }
    double exit() const { return rate == 0 ? never : (cell + (rate > 0 ? 1 : 0) - start) / rate; }
    void step() { cell += rate > 0 ? 1 : -1; }
};

/// The least t in [from, to] at which the patch of a cell is at or above the ray; infinite if there
/// is none.
double meet_patch(const HeightPlane& plane, const ReliefRay& ray, int i, int j, double from,
                  double to) {
    const double h00 = plane.texel(i, j), h10 = plane.texel(i + 1, j);
    const double h01 = plane.texel(i, j + 1), h11 = plane.texel(i + 1, j + 1);
    const double b = h10 - h00, c = h01 - h00, d = h11 - h10 - c;
    const double f = ray.x + ray.dx * from - i, g = ray.y + ray.dy * from - j;
    // The field less the ray, of t - from.
    const double square = d * ray.dx * ray.dy - ray.bend;
    const double linear =
        b * ray.dx + c * ray.dy + d * (f * ray.dy + g * ray.dx) + 1 - 2 * ray.bend * from;
    const double constant = h00 + b * f + c * g + d * f * g - ray.height(from);
    if (constant >= 0) return from;
    const double t = from + least_root(square, linear, constant);
    return t <= to ? t : never;
}

}  // namespace

double first_meeting(const HeightPlane& plane, const ReliefRay& ray) {
    const double floor = least_root(ray.bend, -1, ray.z);
    const double out = ray.bend > 0 ? least_root(ray.bend, -1, ray.z - 1) : never;
    const double end = std::min(ray.z > 0 ? floor : 0, out);
    Walk x(ray.x, ray.dx), y(ray.y, ray.dy);
    for (double from = 0;;) {
        const double exit = std::min(x.exit(), y.exit());
        const double to = std::max(from, std::min(exit, end));
        const double t = meet_patch(plane, ray, x.cell, y.cell, from, to);
        if (t < never) return t;
        if (exit >= end) return out < floor ? -1 : end;
        (x.exit() <= y.exit() ? x : y).step();
        from = to;
    }
}

}  // namespace quadrel
