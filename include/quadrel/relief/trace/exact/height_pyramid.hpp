// A search down and up a pyramid of greatest heights, over dual cells or texels. A node that lies
// below the ray to its far side is left in one step; any other is gone down into, until a cell has
// to be tested.
#pragma once

#include "quadrel/relief/trace/exact/quick_pyramid.hpp"

namespace quadrel {

/// Where a node is, lane by lane.
template <Number F>
struct PyramidPlace {
    CellBlock<F> block;                        ///< as cells around the ray's
    Int<F> column, row;                        ///< in its level
    Mask<F> leaves_parent_x, leaves_parent_y;  ///< the border ahead is one of the node's parent too

    /// Whether the border that is crossed is one of the parent.
    Mask<F> leaves_parent(const CellExit<F>& exit) const {
        const Mask<F> across_y = !exit.across_x;
        return (exit.across_x & leaves_parent_x) | (across_y & leaves_parent_y);
    }
};
template <Number F>
struct PyramidNode {
    PyramidPlace<F> place;
    F height;  ///< the greatest in it, NaN if one is
};

/// A map of BakeKind::max_mip or texel_max; of any pyramid over a grid, where its nodes are.
template <Number F>
class HeightPyramid {
  public:
    HeightPyramid(const SampledTexture& map, const Grid& grid) : map_(map), grid_(grid) {}

    const SampledTexture& map() const { return map_; }
    Int<F> top() const { return Int<F>(levels() - 1); }
    int levels() const { return map_.view.levels; }

    /// The node of `level` around the cell where each ray is.
    PyramidNode<F> node(const CellSearch<F>& search, Int<F> level) const {
        const PyramidPlace<F> at = place(search, level);
        return {at, first_channel<F>(map_.view, at.column, at.row, level)};
    }
    PyramidPlace<F> place(const CellSearch<F>& search, Int<F> level) const {
        const Span x = span(search.i, grid_.u, level, search.ray.x.forward());
        const Span y = span(search.j, grid_.v, level, search.ray.y.forward());
        return {{x.low, y.low, x.high, y.high}, x.index, y.index, x.leaves_parent, y.leaves_parent};
    }

  private:
    /// One axis of a node.
    struct Span {
        Int<F> index, low, high;
        Mask<F> leaves_parent;
    };

    static Span span(Int<F> cell, const GridAxis& axis, Int<F> level, Mask<F> forward) {
        const Int<F> stored = stored_index<F>(cell, axis), count(axis.count), one(1);
        const Int<F> index = shift_right(stored, level), first = shift_left(index, level);
        const Int<F> end = min(first + shift_left(one, level), count);
        const Mask<F> odd = (index & one) == one;
        const Int<F> origin = cell - stored;
        const Mask<F> odd_ahead = (forward & odd) | !(forward | odd);
        return {index, origin + first, origin + end, odd_ahead | (forward & (end == count))};
    }

    const SampledTexture& map_;
    Grid grid_;
};

/// A view ray, which falls from height 1 at s = 0 to 0 at s = 1.
template <Number F>
struct FallingRay {
    /// Whether nothing at `height` or below can be a hit before `exit`.
    Mask<F> passes(const CellExit<F>& exit, F height) const {
        return F(1) - min(exit.s, F(1)) > height;
    }
    /// Before this s the ray is above `height`.
    F falls_to(F height) const { return F(1) - height; }
};

/// Searches the cells of `search` from nodes of `level` on. `course` says where the ray passes
/// above (as FallingRay). `ascent`: how many levels to go up after a node has been left; -1: one
/// where its border is one of its parent too. `leaf(mask, exit, height)` tests cells; `visit(mask,
/// height)` is told of the nodes that are not.
template <Number F, class Course, class Leaf, class Visit>
void descend_pyramid(CellSearch<F>& search, const HeightPyramid<F>& pyramid, Int<F> level,
                     const Course& course, int ascent, const Leaf& leaf, const Visit& visit) {
    for (const auto k : rounds<F>()) {
        search.count_step(16, 4 * pyramid.levels() + 64);
        if (none(search.active)) break;
        const Mask<F> active = search.active;
        const PyramidNode<F> node = pyramid.node(search, level);
        const CellExit<F> exit = search.exit(node.place.block);
        const F bound = node.height + search.ray.margin;
        const Mask<F> above = course.passes(exit, bound);
        const Mask<F> finest = level == Int<F>(0), tests = active & !above & finest;
        const Mask<F> down = active & !above & !finest;
        visit(active, node.height);
        if (when(tests)) leaf(tests, exit, node.height);
        const Mask<F> crosses = (active & (above | finest)) & search.active;
        search.leap(crosses, node.place.block, exit);
        const Mask<F> leaves_parent = node.place.leaves_parent(exit);
        const Mask<F> up = crosses & (leaves_parent | Mask<F>(ascent > 0)) & Mask<F>(ascent != 0);
        level = select(up, min(level + Int<F>(ascent > 0 ? ascent : 1), pyramid.top()), level);
        // Into the node, no further than the ray is above all of it.
        search.leap_to(down, min(course.falls_to(bound), exit.s));
        level = select(down, level - Int<F>(1), level);
    }
}

/// Of view rays, from the top of the pyramid.
template <Number F, class Leaf, class Visit>
void search_pyramid(CellSearch<F>& search, const HeightPyramid<F>& pyramid, int ascent,
                    const Leaf& leaf, const Visit& visit) {
    if (!search.counts_steps) return search_pyramid_quickly(search, pyramid.map(), leaf);
    descend_pyramid<F>(search, pyramid, pyramid.top(), FallingRay<F>(), ascent, leaf, visit);
}

}  // namespace quadrel
