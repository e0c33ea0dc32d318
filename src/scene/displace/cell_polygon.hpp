// Half a cell within a triangle: a polygon whose corners are known by what meets in them, so that
// nothing depends on rounding.
#pragma once

#include <array>
#include <cstdint>

#include "scene/displace/lattice.hpp"

namespace quadrel::displacement {

/// A triangle in texture space, counter-clockwise and not without area.
using Corners = std::array<Place, 3>;

/// What an edge of the polygon lies on.
struct Line {
    enum class Kind { x, y, main, anti, side };
    Kind kind;
    std::int64_t number;  ///< x, y, x - y or x + y in cells; which side of the triangle

    /// The coordinate that is constant along it; not of sides.
    std::int64_t of(const Place& p) const {
        switch (kind) {
            case Kind::x:
                return p.x;
            case Kind::y:
                return p.y;
            case Kind::main:
                return p.x - p.y;
            default:
                return p.x + p.y;
        }
    }
};

/// A corner of the polygon, and the edge that begins there.
struct Node {
    enum class Kind { lattice, cut, corner };
    Kind kind = Kind::lattice;
    std::int64_t i = 0, j = 0;  ///< lattice point
    int number = 0;             ///< cut: side of the triangle; corner: corner
    Fraction at;                ///< cut: part of the side
    Line edge{Line::Kind::x, 0};
};

/// A convex polygon of up to 3 + 3 corners.
struct Polygon {
    int count = 0;
    std::array<Node, 8> node;
    void add(const Node& n) { node[static_cast<std::size_t>(count++)] = n; }
};

/// Cell (i, j) on one side of its diagonal, counter-clockwise. `upper`: the half with the corner
/// (i, j + 1), or (i + 1, j + 1) of the anti-diagonal.
Polygon half_cell(std::int64_t i, std::int64_t j, bool main_diagonal, bool upper);

/// The part of it within the triangle; of fewer than 3 corners: none.
Polygon within(const Polygon& half, const Corners& triangle);

/// Negative, 0 or positive: outside of side k of the triangle, on it, inside.
int inside_of(const Node& node, int k, const Corners& triangle);

}  // namespace quadrel::displacement
