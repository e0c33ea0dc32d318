// A ray over the grid of dual cells, with bounds on what rounding does to it.
#pragma once

#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "relief/oracle/heights.hpp"
#include "relief/oracle/interval.hpp"

namespace quadrel::oracle {

/// More cells of a periodic axis on the way than this are not searched.
inline constexpr double most_cells = 0x1p31;

/// Whole tiles are taken off a coordinate before it is scaled: the multiple of the period.
inline double whole_periods(double u, Wrap wrap) {
    if (wrap == Wrap::repeat) return std::floor(u);
    return wrap == Wrap::mirrored_repeat ? 2 * std::floor(u / 2) : 0;
}

/// p(s) = start + rate s, exactly within.
struct Affine {
    Interval start, rate;

    Affine() = default;
    Affine(double constant) : start(constant), rate(0) {}
    Affine(Interval from, Interval by) : start(from), rate(by) {}

    Interval at(Interval s) const { return start + rate * s; }
    /// Where it is 0; the rate is not.
    Interval root() const { return -start / rate; }
    bool moves() const { return !rate.has_zero(); }
    /// By how much s has to go beyond a root to be past it, whatever rounding does: some units in
    /// the last place of what p is made of.
    double slack() const {
        const double parts = start.magnitude() + rate.magnitude();
        return 0x1p-50 * parts / std::min(std::fabs(rate.lo), std::fabs(rate.hi));
    }
};
inline Affine operator-(const Affine& a, const Affine& b) {
    return {a.start - b.start, a.rate - b.rate};
}
inline Affine operator+(const Affine& a, const Affine& b) {
    return {a.start + b.start, a.rate + b.rate};
}

/// Cells [first, last] of one axis.
struct CellRange {
    Index first, last;
    bool is_one() const { return first == last; }
};

/// One axis of a ray; positions are in dual cells, texel centres at whole numbers.
struct RayAxis {
    Affine position;
    GridAxis grid;

    RayAxis(Interval u, Interval K, double s_polygon, int texels, Wrap wrap, const GridAxis& axis)
        : grid(axis) {
        const Interval size(texels), rate = K * size;
        const Interval at_polygon = u - whole_periods(u.lo, wrap);
        const Interval at_top = at_polygon - Interval(s_polygon) * K;
        position = {at_top * size - Interval(0.5), rate};
        start_ = position.start.middle();
        rate_ = position.rate.middle();
        // Eight roundings, where four are made, and what `position` leaves open.
        const double open = position.start.width() + position.rate.width();
        error_ = 0x1p-50 * (position.start.magnitude() + position.rate.magnitude()) + 2 * open;
        slack_ = position.moves() ? position.slack() + 4 * open / std::fabs(rate_) : 0;
    }

    bool forward() const { return position.rate.lo > 0; }
    bool is_finite() const {
        return position.start.magnitude() + position.rate.magnitude() < 0x1p500;
    }
    bool is_too_long() const { return grid.periodic && position.rate.magnitude() > most_cells; }

    Index cell(double x) const {
        const double low = grid.first, high = low + grid.count - 1;
        return static_cast<Index>(std::floor(grid.periodic ? x : std::clamp(x, low, high)));
    }
    /// The cells that the point at s may lie in. Plain double tells, but near a border.
    CellRange cells(double s) const {
        const double near = start_ + rate_ * s, below = std::floor(near);
        if (near - below > error_ && below + 1 - near > error_) return {cell(near), cell(near)};
        const Interval x = position.at(s);
        return {cell(x.lo), cell(x.hi)};
    }
    /// No later than where it meets the far one of two borders, by some units in the last place;
    /// infinite if it never does.
    double exit(double low, double high) const {
        constexpr double never = std::numeric_limits<double>::infinity();
        const double border = forward() ? high : low;
        if (!position.moves() || std::fabs(border) == never) return never;
        return (border - start_) / rate_ - slack_;
    }

  private:
    double start_, rate_;  ///< as double has them
    double error_;         ///< bound on that of start_ + rate_ s for s in [0, 1], and of floor's
    double slack_;         ///< bound on the error of a border's s in [0, 1]
};

/// Height z(s) = start + climb s; climb is -1 or 1.
struct RayHeight {
    double start, climb;

    Interval at(Interval s) const { return Interval(start) + Interval(climb) * s; }
    /// A bound from below for s in [from, to].
    double least(double from, double to) const { return at(climb < 0 ? to : from).lo; }
};

struct GridRay {
    RayAxis x, y;
    RayHeight z;
    double end;  ///< s in [0, end]

    bool is_finite() const { return x.is_finite() && y.is_finite(); }
    bool is_too_long() const { return x.is_too_long() || y.is_too_long(); }
};

inline GridRay range_ray(const Heights& heights, const RayRange& rays) {
    const SamplerState& s = heights.sampler();
    const Grid& grid = heights.grid();
    return {{rays.u, rays.Ku, rays.s_polygon, heights.width(), s.wrap_u, grid.u},
            {rays.v, rays.Kv, rays.s_polygon, heights.height(), s.wrap_v, grid.v},
            {1, -1},
            1};
}

inline GridRay view_ray(const Heights& heights, const Ray& ray) {
    return range_ray(heights, {ray.u, ray.v, ray.Ku, ray.Kv, ray.s_polygon});
}

/// A cell of the first period; of an axis that ends, as it is.
inline double reduced_cell(Index cell, const GridAxis& axis) {
    return static_cast<double>(axis.periodic ? axis.first + stored_cell(cell, axis) : cell);
}

}  // namespace quadrel::oracle
