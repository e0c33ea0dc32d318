// The search down and up a pyramid where no one counts its steps: it begins at a level that suits
// the ray's length, and lanes that have come to a cell wait there until testing pays. Which cells
// are tested, in which order, is the same for every ray: those that do not lie below it, on the way
// to its hit.
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

/// The parts are parameters so that tests can plant errors in them.
template <Number F, class Axis, class Levels = PyramidLevels<F>, class Wait = Waiting>
class QuickPyramidSearch {
  public:
    QuickPyramidSearch(CellSearch<F>& search, const SampledTexture& map)
        : search_(search),
          levels_(map),
          x_(search.ray.x),
          y_(search.ray.y),
          i_(x_.mirrored(search.i)),
          j_(y_.mirrored(search.j)),
          level_(first_level()) {}

    /// `leaf(mask, exit, height)` tests the cells where the rays are.
    template <class Leaf>
    void run(const Leaf& leaf) {
        Mask<F> active = search_.active;
        for (const auto k : rounds<F>()) {
            if (none(active)) break;
            const NodeSpan<F> x = x_.node(i_, level_), y = y_.node(j_, level_);
            const F height = levels_.height(level_, x_.row(y.index, level_) + x.index);
            const F exit_x = x_.exit(x), exit_y = y_.exit(y);
            const CellExit<F> exit{min(exit_x, exit_y), exit_x <= exit_y};
            const F bound = height + search_.ray.margin;
            const Mask<F> above = F(1) - min(exit.s, F(1)) > bound;
            const Mask<F> finest = level_ == Int<F>(0), stays = active & !above;
            const Mask<F> down = stays & !finest, tests = stays & finest;
            Mask<F> crosses = active & !(down | Wait::held(tests));
            if (Wait::pays(tests, search_.tests_are_costly ? active : tests)) {
                search_.i = x_.mirrored(i_);
                search_.j = y_.mirrored(j_);
                search_.active = active;
                leaf(tests, exit, height);
                active = search_.active;
                crosses = crosses | (tests & active);
            }
            // Into the node, no further than the ray is above all of it.
            const F s = select(down, min(F(1) - bound, exit.s), exit.s);
            const Mask<F> goes = crosses | (down & (s > F(0))), ends = goes & (s >= F(1));
            active = active & !ends;
            const Mask<F> over_x = crosses & exit.across_x, over_y = crosses & !exit.across_x;
            go_on(goes & !ends, over_x, over_y, {x.ahead, y.ahead}, s, down);
            const Mask<F> up = (over_x & x.leaves_parent) | (over_y & y.leaves_parent);
            const Int<F> one(1);
            level_ =
                select(up, min(level_ + one, levels_.top()), select(down, level_ - one, level_));
        }
        search_.active = active;
    }

  private:
    struct Cells {
        Int<F> i, j;
    };

    /// Nodes of which a ray that goes through the whole relief crosses four to eight.
    Int<F> first_level() const {
        const F cells = max(max(x_.rate(), y_.rate()), F(1));
        const Int<F> level = to_int_in_range(exponent(cells)) - Int<F>(2);
        return min(max(level, Int<F>(0)), levels_.top());
    }

    /// To `ahead` in x or in y; else to the cell at s. Borders of the other axis that come earlier
    /// have been crossed then, and of those at s, all where `closed`, else that in x before that in
    /// y.
    void go_on(Mask<F> moves, Mask<F> over_x, Mask<F> over_y, const Cells& ahead, F s,
               Mask<F> closed) {
        const F x = x_.at(s), y = y_.at(s);
        Cells to{x_.cell(floor(x)), y_.cell(floor(y))};
        const Mask<F> certain =
            (over_x | x_.is_between_borders(x)) & (over_y | y_.is_between_borders(y));
        if (when(moves & !certain)) {
            to.i = x_.mirrored(search_.ray.x.locate(moves, s, Mask<F>(true)));
            to.j = y_.mirrored(search_.ray.y.locate(moves, s, closed));
        }
        i_ = select(moves, select(over_x, ahead.i, max(i_, to.i)), i_);
        j_ = select(moves, select(over_y, ahead.j, max(j_, to.j)), j_);
    }

    CellSearch<F>& search_;
    Levels levels_;
    Axis x_, y_;
    Int<F> i_, j_, level_;  ///< cells as the axes have them
};

/// Finds what search_pyramid finds.
template <Number F, class Leaf>
void search_pyramid_quickly(CellSearch<F>& search, const SampledTexture& map, const Leaf& leaf) {
    if (PowerOfTwoAxis<F>::serves(search.ray.x.grid) &&
        PowerOfTwoAxis<F>::serves(search.ray.y.grid)) {
        QuickPyramidSearch<F, PowerOfTwoAxis<F>>(search, map).run(leaf);
    } else {
        QuickPyramidSearch<F, AnyAxis<F>>(search, map).run(leaf);
    }
}

}  // namespace quadrel
