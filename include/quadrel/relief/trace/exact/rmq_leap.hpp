// rmq-leap: leaps over the rectangle of cells that the ray sweeps, as far as it stays above their
// greatest height, which four look-ups in a range-maximum table give for any rectangle; the leap
// tried next is twice as long after one that reached its end, else half as long. Where it comes
// down to one cell, the bilinear patch is met exactly.
//
// After Thonat, Sun, Carr, Boubekeur, "RMIP: Displacement Ray Tracing via Inversion and Oblong
// Bounding", SIGGRAPH Asia 2023, for a planar base: rays are straight in the texture, so that no
// bounds of the base are needed. The same hits as texel-exact, bit for bit, for heights in [0, 1].
#pragma once

#include <bit>

#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

/// A map of BakeKind::rmq.
template <Number F>
class RangeMaxima {
  public:
    RangeMaxima(const SampledTexture& map, const Grid& grid)
        : view_(map.view),
          grid_(grid),
          last_column_log_(std::bit_width(static_cast<std::uint32_t>(map.view.width[0])) - 1) {}

    /// Whether the table has the rectangle: not more than a period.
    Mask<F> holds(const CellBlock<F>& block) const {
        return (block.high_i - block.low_i <= Int<F>(grid_.u.count)) &
               (block.high_j - block.low_j <= Int<F>(grid_.v.count));
    }

    /// Greatest height of a rectangle that it holds; the maximum of four that overlap, NaN if one
    /// is NaN. The others' values are harmless.
    F operator()(const CellBlock<F>& block) const {
        const Mask<F> held = holds(block);
        const Side x = side(block.low_i, block.high_i, grid_.u, held);
        const Side y = side(block.low_j, block.high_j, grid_.v, held);
        const Int<F> layer = y.log * Int<F>(last_column_log_ + 1) + x.log;
        const Int<F> rows(view_.height[0]);
        const auto look_up = [&](Int<F> i, Int<F> j) {
            return first_channel<F>(view_, i, layer * rows + j);
        };
        const F a = either(look_up(x.low, y.low), look_up(x.high, y.low));
        return either(a, either(look_up(x.low, y.high), look_up(x.high, y.high)));
    }

  private:
    /// Two spans of 2^log cells that cover one side of the rectangle, by their stored first cells.
    struct Side {
        Int<F> log, low, high;
    };
    static Side side(Int<F> low, Int<F> high, const GridAxis& axis, Mask<F> held) {
        const F size = select(held, to_float<F>(high - low), F(1));
        const F log = exponent(size);
        return {to_int(log), stored_index<F>(low, axis),
                stored_index<F>(select(held, high - to_int(power_of_two(log)), low), axis)};
    }
    static F either(F a, F b) { return select((b > a) | is_nan(b), b, a); }

    const TextureView& view_;
    Grid grid_;
    int last_column_log_;
};

struct RmqLeap : PatchTrace {
    static constexpr StageText text{"rmq-leap", "trace",
                                    "leaps over swept rectangles by range maxima, patches exact",
                                    "after Thonat et al. 2023"};
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::rmq);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const RangeMaxima<F> maxima(*io.template texture<TextureSlot::rmq>(), search.grid());
        F s(0), length(0.5f);
        for (const auto k : rounds<F>()) {
            search.count_step(64, 256);
            if (none(search.active)) break;
            const Mask<F> active = search.active;
            s = max(s, search.entry());
            const F target = min(s + length, F(1));
            const CellBlock<F> swept = sweep(search, target);
            const F bound = maxima(swept) + search.ray.margin;
            search.template record_node<TextureSlot::rmq, 4>(active, bound - search.ray.margin);
            const CellExit<F> exit = search.exit(search.cell());
            // Nothing but this cell, or it has no part ahead: the ray passes through its corner.
            const Mask<F> one =
                (swept.high_i - swept.low_i + swept.high_j - swept.low_j == Int<F>(2)) |
                (exit.s <= s);
            const Mask<F> held = maxima.holds(swept);
            const Mask<F> above = held & (F(1) - min(exit.s, F(1)) > bound);
            const Mask<F> tests = active & one & !above;
            if (when(tests)) search.test(tests, exit);
            search.step(search.active & one, exit);
            // As far as the ray is above all of the rectangle.
            const F leap = select(held, min(F(1) - bound, target), F(0));
            search.leap_to(search.active & !one, leap);
            s = select((leap > s) & !one, leap, s);
            length = length * select(one | (leap == target), F(2), F(0.5f));
        }
        search.store();
    }

  private:
    /// From the ray's cell to the one at s.
    template <Number F>
    static CellBlock<F> sweep(const CellSearch<F>& search, F s) {
        const Int<F> i =
            search.ray.x.later(search.i, search.ray.x.locate(search.active, s, Mask<F>(true)));
        const Int<F> j =
            search.ray.y.later(search.j, search.ray.y.locate(search.active, s, Mask<F>(true)));
        return {min(search.i, i), min(search.j, j), max(search.i, i) + Int<F>(1),
                max(search.j, j) + Int<F>(1)};
    }
};

}  // namespace quadrel
