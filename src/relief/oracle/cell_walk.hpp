// Along a ray, cell by cell, past all that lies below it. What is visited or passed over covers the
// whole ray, rounding and all: parts are closed intervals of s, one after the other, and each names
// every cell that the ray may be in. At borders, where rounding leaves open on which side the ray
// is, there is a part of some units in the last place with the cells of both sides.
#pragma once

#include "relief/oracle/grid_ray.hpp"

namespace quadrel::oracle {

struct Part {
    double from, to;
    CellRange x, y;

    bool is_one_cell() const { return x.is_one() && y.is_one(); }
};

/// More nodes and cells than this are not looked at.
inline constexpr int most_steps = 1 << 20;

enum class WalkEnd { passed, stopped, too_long };

class CellWalk {
  public:
    CellWalk(const Heights& heights, const GridRay& ray)
        : heights_(heights), ray_(ray), level_(first_level()) {}

    /// Calls visit(part) for what may not be below the ray, until it returns true.
    template <class Visit>
    WalkEnd run(const Visit& visit) {
        for (double t = 0; t < ray_.end;) {
            if (++steps > most_steps) return WalkEnd::too_long;
            Part part{t, t, ray_.x.cells(t), ray_.y.cells(t)};
            part.to = part.is_one_cell() ? node_exit(part) : t;
            if (!(part.to > t)) {
                part = gap(part);
                level_ = 0;
            }
            const double height = greatest(part);
            const bool below = height < ray_.z.least(t, part.to);
            if (!below && level_ > 0) {
                t = into_node(part, height);
                continue;
            }
            if (!below && visit(part)) return WalkEnd::stopped;
            t = part.to;
            level_ = std::min(level_ + 1, heights_.top());
        }
        return WalkEnd::passed;
    }

    int steps = 0;

  private:
    /// Nodes of which a ray through the whole relief crosses some four to eight.
    int first_level() const {
        const double cells =
            std::max(ray_.x.position.rate.magnitude(), ray_.y.position.rate.magnitude());
        const int level = cells >= 8 ? std::ilogb(cells) - 2 : 0;
        return std::min(level, heights_.top());
    }

    NodeRange node_x(Index cell) const { return Heights::node(cell, heights_.grid().u, level_); }
    NodeRange node_y(Index cell) const { return Heights::node(cell, heights_.grid().v, level_); }

    /// The last s at which the ray is sure to be in the node of its level.
    double node_exit(const Part& part) const {
        const NodeRange x = node_x(part.x.first), y = node_y(part.y.first);
        return std::min({ray_.x.exit(x.low, x.high), ray_.y.exit(y.low, y.high), ray_.end});
    }

    double greatest(const Part& part) const {
        double most = -std::numeric_limits<double>::infinity();
        for (Index j = part.y.first; j <= part.y.last; ++j)
            for (Index i = part.x.first; i <= part.x.last; ++i) {
                const double height = heights_.greatest(node_x(i).index, node_y(j).index, level_);
                if (!(height <= most)) most = height;  // NaN, too: then nothing is below
                if (most != most) return most;
            }
        return most;
    }

    /// Down a level, and on to where the ray is about to come down to the node's height: far enough
    /// above it for intervals to tell.
    double into_node(const Part& part, double height) {
        --level_;
        if (ray_.z.climb > 0) return part.from;
        const double reached = (Interval(ray_.z.start) - height - 0x1p-50).lo;
        return reached > part.from && reached < part.to ? reached : part.from;
    }

    /// Where an axis is past the border that it is at; `from` if it is at none.
    double past_border(const RayAxis& axis, const CellRange& cells, double from) const {
        const double low = static_cast<double>(cells.last);
        const bool between = !cells.is_one();
        const NodeRange cell = Heights::node(cells.first, axis.grid, 0);
        if (!between && axis.exit(cell.low, cell.high) > from) return from;
        const double border = between ? low : axis.forward() ? cell.high : cell.low;
        if (!axis.position.moves()) return ray_.end;
        const Affine to_border = axis.position - border;
        const double past = std::max({to_border.root().hi, from, up(from)}) + to_border.slack();
        // A ray that all but stays on the border: to where its own rounding lets it be past it.
        return axis.cells(past).is_one() ? past : past + axis.position.slack();
    }

    /// The part in which the borders are crossed that the ray is at.
    Part gap(const Part& at) const {
        const double t = at.from;
        double x = past_border(ray_.x, at.x, t), y = past_border(ray_.y, at.y, t);
        // No further than to the next border of an axis that is at none.
        const auto next = [&](const RayAxis& axis, const CellRange& cells) {
            const NodeRange cell = Heights::node(cells.first, axis.grid, 0);
            return axis.exit(cell.low, cell.high);
        };
        if (x == t) y = std::min(y, next(ray_.x, at.x));
        if (y == t) x = std::min(x, next(ray_.y, at.y));
        // Of an axis that stays on its border, as far as the other one's crossing goes.
        const double far = std::max(x, y), near = std::min(x, y);
        const double to = far >= ray_.end && near > t ? near : far;
        Part part{t, std::min(std::max(to, up(t)), ray_.end), at.x, at.y};
        const CellRange end_x = ray_.x.cells(part.to), end_y = ray_.y.cells(part.to);
        part.x = {std::min(at.x.first, end_x.first), std::max(at.x.last, end_x.last)};
        part.y = {std::min(at.y.first, end_y.first), std::max(at.y.last, end_y.last)};
        return part;
    }

    const Heights& heights_;
    const GridRay& ray_;
    int level_;
};

}  // namespace quadrel::oracle
