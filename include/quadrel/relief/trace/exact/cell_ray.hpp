// A ray over a grid of cells. Cells are integers, and the parameter of a border is computed from
// the ray itself, (i - x at s = 0) / (cells per unit of s), never accumulated: it depends on
// nothing but the ray and the border, increases along the ray, and so orders all cells the same way
// for every search, whatever it skips. Where the ray crosses a border in x and one in y at once, x
// is first. Source: Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing",
// Eurographics 1987 (which accumulates).
//
// Grids are infinite: a periodic axis goes on with new indices, on any other the outermost stored
// cell reaches to infinity (the field does not change along that axis there), so that a ray that
// leaves the texture ends in it.
#pragma once

#include "quadrel/num/loop.hpp"
#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/exact/patch.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Rays that cross more borders of a periodic axis than this are not searched: float32 has too few
/// bits to tell their cells apart.
inline constexpr float cell_limit = 1048576.0f;  // 2^20

/// Whether `position`, start + rate s as computed for an s in [0, 1], lies so far between the
/// integers g = floor(position) and g + 1 that their borders' parameters lie on either side of s,
/// as computed too. Then cell g is the ray's, and no division has to tell.
///
/// Let u be the unit roundoff, x = start + rate s without rounding, and rate > 0 (below 0 the same
/// holds mirrored; at 0 there is no border). Rounding of the product and of the sum moves the
/// position from x by at most
///     e = u (|start| + 2 |rate|) (1 + 2u).
/// The parameter of border k, (k - start) / rate with two roundings, is without rounding that of
/// the point start + (k - start) (1 + d), |d| <= 2u + u^2. For k = g and k = g + 1, |k - start| <=
/// |rate| + 1 + e, so that this point is off k by at most
///     f = 2u (|rate| + 1 + e) (1 + u).
/// (Of an axis that does not repeat, g may lie outside of the grid. Its outermost cells reach to
/// infinity; their inner borders lie behind x, or ahead, by more than those of g and g + 1, and
/// (k - start) (1 + d) increases with k.) Hence the border of g has a parameter below s, and that
/// of g + 1 one above, where position - g and g + 1 - position are above e + f. That part is
/// computed with an error of at most u. The sum, e + f + u, is at most
///     u (|start| + 4 |rate| + 3) (1 + 8u),
/// and 2 slack = 2u (4 |start| + 6 |rate| + 2), rounded four times, is above that: by more than
/// u / 2 (1 + |rate|), within which lies what products and quotients that underflow are off.
template <Number F>
F reach_between_borders(F slack) {
    return F(0.5f) - F(2) * slack;
}
/// `reach`: how far from the middle, in cells.
template <Number F>
Mask<F> is_within(F position, F reach) {
    return abs((position - floor(position)) - F(0.5f)) < reach;
}
template <Number F>
Mask<F> is_between_borders(F position, F slack) {
    return is_within(position, reach_between_borders(slack));
}

/// One axis of a ray over a grid.
template <Number F>
struct CellRayAxis {
    F start;        ///< position at s = 0, in cells; cell i is [i, i + 1]
    F rate;         ///< cells per unit of s
    GridAxis grid;  ///< which cells are stored
    F slack;        ///< bound on the error of positions, in cells

    Mask<F> forward() const { return rate > F(0); }
    Int<F> step() const { return select(forward(), Int<F>(1), Int<F>(-1)); }
    F at(F s) const { return start + rate * s; }

    /// s where the ray meets border i, the lower one of cell i.
    F border(Int<F> i) const { return (to_float<F>(i) - start) / rate; }
    /// s where it leaves cells [low, high), or infinity.
    F exit(Int<F> low, Int<F> high) const {
        const Int<F> ahead = select(forward(), high, low);
        const F never(std::numeric_limits<Scalar<F>>::infinity());
        return select(crossable(ahead), border(ahead), never);
    }
    F exit(Int<F> i) const { return exit(i, i + Int<F>(1)); }
    /// s where it enters cell i, or minus infinity.
    F entry(Int<F> i) const {
        const Int<F> behind = select(forward(), i, i + Int<F>(1));
        const F always(-std::numeric_limits<Scalar<F>>::infinity());
        return select(crossable(behind), border(behind), always);
    }
    /// Cell at s = 0; on a border the one above it, which a ray downwards leaves at once.
    Int<F> first() const { return bounded_cell(floor(start)); }

    /// Cell of the ray after all borders with a parameter below s, and where `closed` those at s;
    /// s in [0, 1]. Where `mask`; elsewhere some cell.
    Int<F> locate(Mask<F> mask, F s, Mask<F> closed) const {
        const F position = at(s);
        Int<F> cell = bounded_cell(floor(position));
        if (when(mask & !is_between_borders(position, slack))) cell = by_borders(cell, s, closed);
        return cell;
    }
    /// At most how many borders it crosses for s in [0, 1].
    F most_borders() const {
        const float most = grid.periodic ? cell_limit : static_cast<float>(grid.count);
        return min(ceil(abs(rate)) + F(1), F(most));
    }
    /// The one of two cells that the ray comes to later.
    Int<F> later(Int<F> a, Int<F> b) const { return select(forward(), max(a, b), min(a, b)); }

  private:
    /// From a guess that is off by one at most.
    [[gnu::noinline]] Int<F> by_borders(Int<F> guess, F s, Mask<F> closed) const {
        const auto crossed = [&](F t) { return (t < s) | (closed & (t == s)); };
        const Int<F> back = select(crossed(entry(guess)), guess, guess - step());
        return select(crossed(exit(back)), back + step(), back);
    }
    Mask<F> crossable(Int<F> i) const {
        const Mask<F> moves = rate != F(0);
        if (grid.periodic) return moves;
        return moves & (i > Int<F>(grid.first)) & (i < Int<F>(grid.first + grid.count));
    }
    Int<F> bounded_cell(F x) const {
        if (grid.periodic) return to_int_in_range(x);
        const F low = to_float<F>(Int<F>(grid.first));
        return to_int_in_range(clamp(x, low, low + to_float<F>(Int<F>(grid.count - 1))));
    }
};

template <Number F>
struct CellRay {
    CellRayAxis<F> x, y;
    F margin;          ///< how far below the ray a bound must be for cells to be skipped
    Mask<F> is_nan;    ///< no number, or infinite: not searched
    Mask<F> too_long;  ///< crosses too many borders: not searched

    Mask<F> searchable() const { return !(is_nan | too_long); }
};

/// `uv` is where the polygon is, `K` the shift over the relief. Periodic coordinates are reduced
/// before they are scaled. `centre`: the coordinate of texel 0's centre in cells is centre - 1/2.
template <Number F>
CellRayAxis<F> cell_ray_axis(F u, F K, Scalar<F> s_polygon, std::int32_t texels, Wrap wrap,
                             const GridAxis& grid, float centre) {
    const F size = to_float<F>(Int<F>(texels));
    const F at_polygon = is_periodic(wrap) ? texel_coordinate(u, size, wrap, false) : u * size;
    const F rate = K * size;
    const F start = at_polygon - F(centre) - F(s_polygon) * rate;
    const F slack = F(unit_roundoff<F>) * (F(4) * abs(start) + F(6) * abs(rate) + F(2));
    return {start, rate, grid, slack};
}

template <Number F>
CellRay<F> make_cell_ray(const SearchRay<F>& ray, const SampledTexture& height, const Grid& grid,
                         float centre) {
    const TextureView& view = height.view;
    const SamplerState& sampler = height.sampler;
    CellRay<F> cells;
    cells.x = cell_ray_axis(ray.uv.x, ray.K.x, ray.s_polygon, view.width[0], sampler.wrap_u, grid.u,
                            centre);
    cells.y = cell_ray_axis(ray.uv.y, ray.K.y, ray.s_polygon, view.height[0], sampler.wrap_v,
                            grid.v, centre);
    // No patch's error is above it while heights are in [0, 1].
    cells.margin =
        F(std::max(64 * unit_roundoff<F>, Scalar<F>(0x1p-22))) + cells.x.slack + cells.y.slack;
    const auto long_axis = [](const CellRayAxis<F>& axis) {
        return Mask<F>(axis.grid.periodic) & !(abs(axis.rate) <= F(cell_limit));
    };
    cells.is_nan = !(is_finite(ray.uv.x + ray.uv.y) & is_finite(cells.x.start + cells.x.rate) &
                     is_finite(cells.y.start + cells.y.rate));
    cells.too_long = (long_axis(cells.x) | long_axis(cells.y)) & !cells.is_nan;
    // Lanes that are not searched still compute, and must read inside of their maps.
    for (CellRayAxis<F>* axis : {&cells.x, &cells.y}) {
        axis->start = select(cells.searchable(), axis->start, F(0));
        axis->rate = select(cells.searchable(), axis->rate, F(0));
    }
    return cells;
}

}  // namespace quadrel
