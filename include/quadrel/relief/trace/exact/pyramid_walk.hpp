// Rays on their way over the cells of a pyramid: where they are, the nodes around them, and how
// they go on. What searches that no one counts the steps of share.
#pragma once

#include <algorithm>

#include "quadrel/relief/trace/exact/cell_search.hpp"
#include "quadrel/relief/trace/exact/forward_axis.hpp"

namespace quadrel {

/// When what takes as long for one lane as for all is done.
struct Waiting {
    /// Whether now: for half of the lanes that are left, or more.
    template <class M>
    static bool pays(const M& mask, const M& left) {
        const int lanes = count(mask);
        return lanes > 0 && 2 * lanes >= count(left);
    }
    /// The lanes that stay where they are until then.
    template <class M>
    static M held(const M& mask) {
        return mask;
    }
};

/// A pyramid's levels, of one channel.
template <Number F>
class PyramidLevels {
  public:
    explicit PyramidLevels(const SampledTexture& map) : view_(map.view) {
        std::copy_n(view_.offset, std::min(view_.levels, 16), offsets_);
    }
    Int<F> top() const { return Int<F>(view_.levels - 1); }
    /// Of node `index` of a level.
    F height(Int<F> level, Int<F> index) const {
        return only_channel<F>(view_, begin(level) + index);
    }

  private:
    Int<F> begin(Int<F> level) const {
        return view_.levels <= 16 ? look_up16<F>(offsets_, level)
                                  : gather_int<F>(view_.offset, level);
    }

    const TextureView& view_;
    alignas(64) std::int32_t offsets_[16] = {};
};

/// The nodes around rays.
template <Number F>
struct NodeAround {
    NodeSpan<F> x, y;
    F height;
    CellExit<F> exit;
};

/// The parts are parameters so that tests can plant errors in them.
template <Number F, class Axis, class Levels = PyramidLevels<F>>
class PyramidWalk {
  public:
    PyramidWalk(const CellSearch<F>& search, const SampledTexture& map, Int<F> level)
        : ray_(search.ray),
          levels_(map),
          x_(search.ray.x),
          y_(search.ray.y),
          i_(x_.mirrored(search.i)),
          j_(y_.mirrored(search.j)),
          level_(min(level, levels_.top())) {}

    NodeAround<F> node() const {
        const NodeSpan<F> x = x_.node(i_, level_), y = y_.node(j_, level_);
        const F height = levels_.height(level_, x_.row(y.index, level_) + x.index);
        const F exit_x = x_.exit(x), exit_y = y_.exit(y);
        const Mask<F> across_x = exit_x <= exit_y;
        return {x, y, height, {select(across_x, exit_x, exit_y), across_x}};
    }
    Mask<F> at_cells() const { return level_ == Int<F>(0); }
    /// Tells a search the cells where the rays are.
    void tell(CellSearch<F>& search) const {
        search.i = x_.mirrored(i_);
        search.j = y_.mirrored(j_);
    }

    /// `crosses`: out of the node, up a level where its border is one of its parent, too. `down`:
    /// down a level, or two where a step takes longer than the nodes that this costs. `moves` are
    /// those of both that change their cell, to that at s; `crosses` at its exit.
    void go_on(const NodeAround<F>& node, Mask<F> crosses, Mask<F> down, Mask<F> moves, F s) {
        const Mask<F> over_x = crosses & node.exit.across_x, over_y = crosses & !node.exit.across_x;
        move(moves, over_x, over_y, node, s, down);
        const Mask<F> up = (over_x & node.x.leaves_parent) | (over_y & node.y.leaves_parent);
        const Int<F> one(1), two(2), deeper = level_ - select(level_ > two, two, one);
        level_ = select(up, min(level_ + one, levels_.top()), select(down, deeper, level_));
    }

  private:
    /// To the cell ahead in x or in y; else to the one at s. Borders of the other axis that come
    /// earlier have been crossed then, and of those at s, all where `closed`, else that in x before
    /// that in y.
    void move(Mask<F> moves, Mask<F> over_x, Mask<F> over_y, const NodeAround<F>& node, F s,
              Mask<F> closed) {
        const F x = x_.at(s), y = y_.at(s);
        Int<F> to_i = x_.cell(floor(x)), to_j = y_.cell(floor(y));
        const Mask<F> certain =
            (over_x | x_.is_between_borders(x)) & (over_y | y_.is_between_borders(y));
        if (when(moves & !certain)) {
            to_i = x_.mirrored(ray_.x.locate(moves, s, Mask<F>(true)));
            to_j = y_.mirrored(ray_.y.locate(moves, s, closed));
        }
        i_ = select(moves, select(over_x, node.x.ahead, max(i_, to_i)), i_);
        j_ = select(moves, select(over_y, node.y.ahead, max(j_, to_j)), j_);
    }

    const CellRay<F>& ray_;
    Levels levels_;
    Axis x_, y_;
    Int<F> i_, j_, level_;  ///< cells as the axes have them
};

/// Calls search(Axis) with an axis type that serves the grid: `with_axis<F>(ray, [&]<class Axis>()
/// { ... })`.
template <Number F, class Search>
void with_axis(const CellRay<F>& ray, const Search& search) {
    if (PowerOfTwoAxis<F>::serves(ray.x.grid) && PowerOfTwoAxis<F>::serves(ray.y.grid))
        search.template operator()<PowerOfTwoAxis<F>>();
    else
        search.template operator()<AnyAxis<F>>();
}

}  // namespace quadrel
