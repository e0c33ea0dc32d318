// The parts of a surface over one dual cell: one patch, two triangles, or the quarters of four
// blocks. Lines through the cell, straight ones, part them.
//
// T is Interval or a rational: then all of it is exact.
#pragma once

#include <array>

#include "relief/oracle/grid_ray.hpp"

namespace quadrel::oracle {

inline constexpr int most_lines = 2;

/// On which side of each line a point is: bit k, at or beyond line k.
using Sides = unsigned;

inline int line_count(Surface surface) {
    if (surface == Surface::bilinear) return 0;
    return surface == Surface::block ? 2 : 1;
}

/// Whether a cell's triangles share the edge from (0, 0) to (1, 1). tri-min: by differences as
/// double has them.
inline bool has_main_edge(Surface surface, const Corners& h) {
    if (surface != Surface::tri_min) return surface == Surface::tri_main;
    return std::fabs(h.h00 - h.h11) <= std::fabs(h.h10 - h.h01);
}

/// Line k of a cell, f and g from its low corner: what is 0 on it, positive beyond.
template <class T>
T line(Surface surface, bool main_edge, int k, const T& f, const T& g) {
    if (surface == Surface::block) return (k == 0 ? f : g) - T(0.5);
    return main_edge ? T(f - g) : T(f + g - T(1));
}

/// height = a + b f + c g + d f g, f and g from corner (i, j) of the plane's texels.
template <class T>
struct Piece {
    T a, b, c, d;
    Index i, j;
    Index cell_i, cell_j;  ///< the cell that is met: of blocks the texel, else the dual cell
    double least;          ///< of its heights, those of its corners

    T height(const T& f, const T& g) const { return T(a + b * f) + T(T(c + d * f) * g); }
};

/// The piece of cell (i, j) on those sides of its lines.
template <class T>
Piece<T> piece_of(Surface surface, const Corners& h, Index i, Index j, Sides sides) {
    const T zero(0.0);
    if (surface == Surface::block) {
        const std::array<double, 4> heights{h.h00, h.h10, h.h01, h.h11};
        const double height = heights[sides & 3];
        return {T(height), zero, zero, zero, i, j, i + (sides & 1), j + (sides >> 1), height};
    }
    const T h00(h.h00), h10(h.h10), h01(h.h01), h11(h.h11);
    const T b(h10 - h00), c(h01 - h00), far_b(h11 - h01), far_c(h11 - h10);
    const double least = h.least();
    if (surface == Surface::bilinear) return {h00, b, c, T(far_b - b), i, j, i, j, least};
    const bool beyond = (sides & 1) != 0;
    if (has_main_edge(surface, h)) {
        if (beyond) return {h00, b, far_c, zero, i, j, i, j, least};
        return {h00, far_b, c, zero, i, j, i, j, least};
    }
    if (!beyond) return {h00, b, c, zero, i, j, i, j, least};
    // About the corner beyond, so that each plane is given at one of its own corners.
    return {h11, far_b, far_c, zero, i + 1, j + 1, i, j, least};
}

}  // namespace quadrel::oracle
