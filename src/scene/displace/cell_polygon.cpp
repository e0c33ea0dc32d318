#include "scene/displace/cell_polygon.hpp"

namespace quadrel::displacement {
namespace {

int sign_of(Int128 x) { return (x > 0) - (x < 0); }

Node lattice_node(std::int64_t i, std::int64_t j, Line::Kind edge, std::int64_t number) {
    Node node;
    node.i = i;
    node.j = j;
    node.edge = {edge, number};
    return node;
}

/// Where an edge of the polygon meets side k: never called where they are parallel.
Node meeting(const Line& edge, int k, const Corners& triangle) {
    Node node;
    if (edge.kind == Line::Kind::side) {
        const int other = static_cast<int>(edge.number);
        node.kind = Node::Kind::corner;
        node.number = other == (k + 1) % 3 ? other : k;
        return node;
    }
    const Place &a = triangle[static_cast<std::size_t>(k)],
                &b = triangle[static_cast<std::size_t>((k + 1) % 3)];
    node.kind = Node::Kind::cut;
    node.number = k;
    node.at = crossing(edge.of(a), edge.of(b), edge.number * one);
    return node;
}

/// The part inside of side k.
Polygon inside_part(const Polygon& polygon, int k, const Corners& triangle) {
    Polygon part;
    for (int n = 0; n < polygon.count; ++n) {
        Node here = polygon.node[static_cast<std::size_t>(n)];
        const Node& next = polygon.node[static_cast<std::size_t>((n + 1) % polygon.count)];
        const int at_here = inside_of(here, k, triangle), at_next = inside_of(next, k, triangle);
        const Line edge = here.edge, side{Line::Kind::side, k};
        if (at_here == 0 && at_next < 0) here.edge = side;
        if (at_here >= 0) part.add(here);
        if (at_here * at_next >= 0) continue;
        Node crossing_point = meeting(edge, k, triangle);
        crossing_point.edge = at_here > 0 ? side : edge;
        part.add(crossing_point);
    }
    return part;
}

}  // namespace

int inside_of(const Node& node, int k, const Corners& triangle) {
    const auto first = static_cast<std::size_t>(k), second = static_cast<std::size_t>((k + 1) % 3);
    if (node.kind == Node::Kind::lattice)
        return sign_of(side_of(triangle[first], triangle[second], {node.i * one, node.j * one}));
    if (node.kind == Node::Kind::corner) return node.number == (k + 2) % 3 ? 1 : 0;
    if (node.number == k) return 0;
    // The next side begins on this one, the one before ends there.
    if (node.number == (k + 1) % 3) return sign_of(node.at.numerator);
    return sign_of(node.at.denominator - node.at.numerator);
}

Polygon half_cell(std::int64_t i, std::int64_t j, bool main_diagonal, bool upper) {
    using enum Line::Kind;
    Polygon half;
    if (main_diagonal && !upper) {
        half.add(lattice_node(i, j, y, j));
        half.add(lattice_node(i + 1, j, x, i + 1));
        half.add(lattice_node(i + 1, j + 1, main, i - j));
    } else if (main_diagonal) {
        half.add(lattice_node(i, j, main, i - j));
        half.add(lattice_node(i + 1, j + 1, y, j + 1));
        half.add(lattice_node(i, j + 1, x, i));
    } else if (!upper) {
        half.add(lattice_node(i, j, y, j));
        half.add(lattice_node(i + 1, j, anti, i + j + 1));
        half.add(lattice_node(i, j + 1, x, i));
    } else {
        half.add(lattice_node(i + 1, j, x, i + 1));
        half.add(lattice_node(i + 1, j + 1, y, j + 1));
        half.add(lattice_node(i, j + 1, anti, i + j + 1));
    }
    return half;
}

Polygon within(const Polygon& half, const Corners& triangle) {
    Polygon part = half;
    for (int k = 0; k < 3 && part.count >= 3; ++k) part = inside_part(part, k, triangle);
    return part;
}

}  // namespace quadrel::displacement
