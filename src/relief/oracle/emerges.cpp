#include "quadrel/relief/trace/oracle/emerges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relief/oracle/piece.hpp"

namespace quadrel::oracle {
namespace {

/// How far the field must be below the ray, in units of the relief's depth.
constexpr double least_gap = 0x1p-20;
constexpr int most_cells_between = 1 << 16;

/// p(s) = start + rate s, in dual cells.
struct Position {
    double start, rate;

    double at(double s) const { return start + rate * s; }
    /// The s > from at which it comes to `line`; infinite if it never does.
    double reaches(double line, double from) const {
        const double s = (line - start) / rate;
        return s > from ? s : std::numeric_limits<double>::infinity();
    }
    /// Where it leaves the cell that it is in right after `from`.
    double leaves(Index cell, double from) const {
        return reaches(static_cast<double>(rate > 0 ? cell + 1 : cell), from);
    }
};

Position position(double u, double K, double s_polygon, double texels, Wrap wrap) {
    const double at_top = u - whole_periods(u, wrap) - s_polygon * K;
    return {at_top * texels - 0.5, K * texels};
}

class Between {
  public:
    Between(const Field& field, const Ray& ray)
        : surface_(field.surface),
          heights_(field),
          x_(position(ray.u, ray.Ku, ray.s_polygon, heights_.width(), heights_.sampler().wrap_u)),
          y_(position(ray.v, ray.Kv, ray.s_polygon, heights_.height(), heights_.sampler().wrap_v)) {
    }

    bool has_gap(double from, double to) const {
        int cells = 0;
        while (from < to && ++cells < most_cells_between) {
            // The cell of a point within the next stretch, whatever rounding does at a border.
            const double probe = std::min(to, from + 0x1p-40);
            const Index i = cell(x_.at(probe)), j = cell(y_.at(probe));
            const double end = std::min({to, x_.leaves(i, probe), y_.leaves(j, probe)});
            if (cell_has_gap(i, j, from, end)) return true;
            from = end;
        }
        return false;
    }

  private:
    static Index cell(double x) {
        constexpr double far = 0x1p60;
        return static_cast<Index>(std::floor(std::clamp(x, -far, far)));
    }

    /// In one cell, part by part between the lines that its pieces share.
    bool cell_has_gap(Index i, Index j, double from, double to) const {
        const Corners corners = heights_.corners(i, j);
        if (!corners.finite()) return false;
        const bool main = has_main_edge(surface_, corners);
        double crossed[most_lines] = {to, to};
        for (int k = 0; k < line_count(surface_); ++k) {
            const double a = side_of_line(main, k, i, j, from), b = side_of_line(main, k, i, j, to);
            if ((a < 0) != (b < 0)) crossed[k] = from + (to - from) * (a / (a - b));
        }
        const double first = std::min(crossed[0], crossed[1]),
                     second = std::max(crossed[0], crossed[1]);
        return part_has_gap(main, corners, i, j, from, first) ||
               part_has_gap(main, corners, i, j, first, second) ||
               part_has_gap(main, corners, i, j, second, to);
    }

    double side_of_line(bool main, int k, Index i, Index j, double s) const {
        return line(surface_, main, k, x_.at(s) - static_cast<double>(i),
                    y_.at(s) - static_cast<double>(j));
    }

    bool part_has_gap(bool main, const Corners& corners, Index i, Index j, double from,
                      double to) const {
        const double middle = from + (to - from) / 2;
        Sides sides = 0;
        for (int k = 0; k < line_count(surface_); ++k)
            if (side_of_line(main, k, i, j, middle) >= 0) sides |= 1u << k;
        const Piece<double> piece = piece_of<double>(surface_, corners, i, j, sides);
        const auto above = [&](double s) {
            return piece.height(x_.at(s) - static_cast<double>(piece.i),
                                y_.at(s) - static_cast<double>(piece.j)) -
                   (1 - s);
        };
        const double a = above(from), m = above(middle), b = above(to);
        if (std::min({a, m, b}) < -least_gap) return true;
        // F is a parabola through the three; where it opens upwards its vertex may lie lower.
        const double half = to - middle, slope = (b - a) / 2, bend = (a + b) / 2 - m;
        if (!(bend > 0) || std::fabs(slope) >= 2 * bend) return false;
        return half > 0 && m - slope * slope / (4 * bend) < -least_gap;
    }

    Surface surface_;
    Heights heights_;
    Position x_, y_;
};

}  // namespace

bool emerges(const Field& field, const Ray& ray, double from, double to) {
    from = std::max(from, 0.0);
    to = std::min(to, 1.0);
    if (!(from < to) || !std::isfinite(ray.u + ray.v + ray.Ku + ray.Kv)) return false;
    return Between(field, ray).has_gap(from, to);
}

}  // namespace quadrel::oracle
