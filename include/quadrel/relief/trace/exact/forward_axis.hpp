// One axis of a ray over a grid, mirrored where the ray runs downwards, so that it only ever goes
// on to higher cells: cell i is cell ~i = -1 - i there. Negating is exact, so all borders keep
// their parameters, and a search has nothing to choose by the ray's direction.
#pragma once

#include <bit>
#include <concepts>

#include "quadrel/relief/trace/exact/cell_ray.hpp"

namespace quadrel {

/// Where the node of a pyramid around the ray's cell lies along an axis.
template <Number F>
struct NodeSpan {
    Int<F> index;           ///< of the node, as it is stored
    Int<F> ahead;           ///< the first cell behind it on the way
    Mask<F> leaves_parent;  ///< that is in another parent node (a hint: any answer is right)
};

/// A whole number, |x| < 2^22, as an integer: sooner than by a conversion, which minds all that
/// does not fit. Of anything else, some integer.
template <Number F>
Int<F> whole_number(F x) {
    if constexpr (std::same_as<Scalar<F>, float>)
        return as_int(x + F(0x1.8p23f)) - Int<F>(0x4b400000);
    else
        return to_int_in_range(x);
}

template <Number F>
class ForwardAxis {
  public:
    explicit ForwardAxis(const CellRayAxis<F>& axis)
        : start_(select(axis.rate < F(0), -axis.start, axis.start)),
          rate_(abs(axis.rate)),
          reach_(reach_between_borders(axis.slack)),
          flip_(select(axis.rate < F(0), Int<F>(-1), Int<F>(0))) {}

    /// A cell of the grid here, and back.
    Int<F> mirrored(Int<F> cell) const { return cell ^ flip_; }
    F rate() const { return rate_; }
    F at(F s) const { return start_ + rate_ * s; }
    /// s where the ray enters cell i. Of a cell ahead of it: infinite where it does not move.
    F entry(Int<F> i) const { return (to_float<F>(i) - start_) / rate_; }
    Mask<F> is_between_borders(F position) const { return is_within(position, reach_); }

  protected:
    F start_, rate_;  ///< as of CellRayAxis; the rate is >= 0
    F reach_;         ///< of is_within
    Int<F> flip_;     ///< -1 where mirrored, else 0
};

/// An axis that repeats after 2^k cells: nodes by masks and shifts.
template <Number F>
class PowerOfTwoAxis : public ForwardAxis<F> {
  public:
    static bool serves(const GridAxis& grid) {
        return grid.periodic && grid.first == 0 && is_power_of_two(grid.count);
    }
    explicit PowerOfTwoAxis(const CellRayAxis<F>& axis)
        : ForwardAxis<F>(axis),
          mask_(axis.grid.count - 1),
          log_(std::countr_zero(static_cast<std::uint32_t>(axis.grid.count))) {}

    NodeSpan<F> node(Int<F> cell, Int<F> level) const {
        const Int<F> log = min(level, log_), next = shift_right(cell, log) + Int<F>(1);
        return {shift_right(this->mirrored(cell) & mask_, log), shift_left(next, log),
                (next & Int<F>(1)) == Int<F>(0)};
    }
    /// Index of the first node of a row of `level`, this axis running along rows.
    Int<F> row(Int<F> number, Int<F> level) const {
        return shift_left(number, log_ - min(level, log_));
    }
    F exit(const NodeSpan<F>& node) const { return this->entry(node.ahead); }
    /// The cell between the integer-valued position `low` and the next.
    Int<F> cell(F low) const { return whole_number(low); }

  private:
    Int<F> mask_, log_;
};

/// Any axis.
template <Number F>
class AnyAxis : public ForwardAxis<F> {
  public:
    explicit AnyAxis(const CellRayAxis<F>& axis) : ForwardAxis<F>(axis), grid_(axis.grid) {
        const std::int32_t end = grid_.first + grid_.count;
        const Mask<F> back = this->flip_ < Int<F>(0);
        first_ = select(back, Int<F>(-end), Int<F>(grid_.first));
        end_ = select(back, Int<F>(-grid_.first), Int<F>(end));
    }

    NodeSpan<F> node(Int<F> cell, Int<F> level) const {
        const Int<F> one(1), count(grid_.count);
        const Int<F> stored = stored_index<F>(this->mirrored(cell), grid_);
        const Int<F> index = shift_right(stored, level), first = shift_left(index, level);
        const Int<F> end = min(first + shift_left(one, level), count);
        const Int<F> left = select(this->flip_ < Int<F>(0), stored - first + one, end - stored);
        return {index, cell + left, ((this->mirrored(index) & one) == one) | (end == count)};
    }
    Int<F> row(Int<F> number, Int<F> level) const {
        const Int<F> one(1);
        return number * (shift_right(Int<F>(grid_.count - 1), level) + one);
    }
    F exit(const NodeSpan<F>& node) const {
        const F never(std::numeric_limits<Scalar<F>>::infinity());
        const F at_border = this->entry(node.ahead);
        return grid_.periodic ? at_border : select(node.ahead < end_, at_border, never);
    }
    Int<F> cell(F low) const {
        if (grid_.periodic) return whole_number(low);
        const Int<F> last = end_ - Int<F>(1);
        return whole_number(clamp(low, to_float<F>(first_), to_float<F>(last)));
    }

  private:
    GridAxis grid_;
    Int<F> first_, end_;  ///< of the stored cells, mirrored as the axis is
};

}  // namespace quadrel
