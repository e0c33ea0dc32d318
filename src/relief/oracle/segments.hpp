// A part of a ray, split where it crosses the lines that its cells' pieces share.
#pragma once

#include "relief/oracle/cell_walk.hpp"
#include "relief/oracle/segment.hpp"

namespace quadrel::oracle {

/// On which side of a line the ray is at s: 1 beyond, 0 before, -1 if rounding leaves it open.
inline int side_of(const Affine& line, double s) {
    const Interval at = line.at(s);
    return at.lo >= 0 ? 1 : at.hi < 0 ? 0 : -1;
}

class CellSegments {
  public:
    CellSegments(Surface surface, const Heights& heights, const GridRay& ray, const Part& part)
        : surface_(surface), heights_(heights), ray_(ray), part_(part) {}

    /// Whether all heights that it reads are finite.
    bool finite() const {
        for (Index j = part_.y.first; j <= part_.y.last; ++j)
            for (Index i = part_.x.first; i <= part_.x.last; ++i)
                if (!heights_.corners(i, j).finite()) return false;
        return true;
    }

    /// Calls visit(segment) in order until it returns true, and returns whether it did.
    template <class Visit>
    bool each(const Visit& visit) {
        Segment segment;
        for (double from = part_.from; from < part_.to; from = segment.to) {
            segment.from = from;
            segment.to = part_.is_one_cell() ? end_of(from) : part_.to;
            collect(segment);
            if (visit(segment)) return true;
        }
        return false;
    }

  private:
    struct Cell {
        Index i, j;
        Corners corners;
        int lines;
        Affine line[most_lines];
    };

    Cell cell(Index i, Index j) const {
        Cell made{i, j, heights_.corners(i, j), line_count(surface_), {}};
        const bool main = has_main_edge(surface_, made.corners);
        for (int k = 0; k < made.lines; ++k)
            made.line[k] = line(surface_, main, k, ray_.x.position - static_cast<double>(i),
                                ray_.y.position - static_cast<double>(j));
        return made;
    }

    /// How far from `from` on the ray is in one piece; if it is on a line, to where it is past it.
    double end_of(double from) const {
        const Cell of = cell(part_.x.first, part_.y.first);
        double to = part_.to, past = from;
        for (int k = 0; k < of.lines; ++k) {
            const Affine& line = of.line[k];
            const int side = side_of(line, from);
            if (side >= 0 && side == side_of(line, part_.to)) continue;
            if (!line.moves()) {
                past = part_.to;
                continue;
            }
            const Interval root = line.root();
            if (side >= 0 && root.lo > from) {
                to = std::min(to, root.lo);
            } else {
                past = std::max({past, root.hi + line.slack(), up(from)});
            }
        }
        return past > from ? std::min(past, part_.to) : to;
    }

    /// Where the line is met at the earliest; before that is no point of it.
    static double next_crossing(const Affine& line) {
        return line.moves() ? line.root().lo : -std::numeric_limits<double>::infinity();
    }

    void collect(Segment& segment) const {
        segment.count = 0;
        segment.last = -1;
        segment.complete = true;
        const CellRange x = ray_.x.cells(segment.to), y = ray_.y.cells(segment.to);
        for (Index j = part_.y.first; j <= part_.y.last; ++j)
            for (Index i = part_.x.first; i <= part_.x.last; ++i) {
                const bool ends_here = x.is_one() && y.is_one() && x.first == i && y.first == j;
                collect(cell(i, j), ends_here || part_.is_one_cell(), segment);
            }
    }

    void collect(const Cell& of, bool ends_here, Segment& segment) const {
        for (Sides sides = 0; sides < (1u << of.lines); ++sides) {
            bool possible = true, last = ends_here;
            for (int k = 0; k < of.lines; ++k) {
                const int side = static_cast<int>(sides >> k & 1);
                const int first = side_of(of.line[k], segment.from);
                const int end = side_of(of.line[k], segment.to);
                // Up to where it meets the line, it stays on the side on which it is.
                const bool stays = first == end || segment.to <= next_crossing(of.line[k]);
                possible = possible && !(stays && first == 1 - side);
                last = last && end == side;
            }
            if (!possible) continue;
            if (segment.count == Segment::most_pieces) {
                segment.complete = false;
                return;
            }
            if (last) segment.last = segment.count;
            segment.pieces[static_cast<std::size_t>(segment.count++)] =
                piece_of<Interval>(surface_, of.corners, of.i, of.j, sides);
        }
    }

    Surface surface_;
    const Heights& heights_;
    const GridRay& ray_;
    const Part& part_;
};

}  // namespace quadrel::oracle
