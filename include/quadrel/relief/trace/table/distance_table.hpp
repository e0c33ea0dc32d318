// Look-ups in tables of distances by place, layer and direction, linear in each.
#pragma once

#include "quadrel/relief/direction_table.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Two stored neighbours of one dimension of a table, and how far a place is from the first.
template <Number F>
struct TablePlace {
    Int<F> low, high;
    F part;

    /// Of `count` nodes at 0, 1, ...; nearest to where `at` is outside of them, 0 where it is NaN.
    static TablePlace clamped(F at, std::int32_t count) {
        const F inside =
            select(is_nan(at), F(0), clamp(at, F(0), F(static_cast<Scalar<F>>(count - 1))));
        const F low = floor(inside);
        const Int<F> first = to_int(low);
        return {first, min(first + Int<F>(1), Int<F>(count - 1)), inside - low};
    }
    /// Of nodes that repeat after `count`.
    static TablePlace repeated(F at, std::int32_t count) {
        constexpr float most = 4194304;  // 2^22: whole numbers, and where they are stored
        const F inside = select(is_nan(at), F(0), clamp(at, F(-most), F(most)));
        const F low = floor(inside);
        const Int<F> first = to_int(low);
        return {floor_mod<F>(first, count), floor_mod<F>(first + Int<F>(1), count), inside - low};
    }
    /// Of nodes in the middles of blocks that cover an axis of the height map's stored texels.
    static TablePlace of_coordinate(F u, std::int32_t texels, const GridAxis& axis,
                                    std::int32_t blocks) {
        const F from_first = u * to_float<F>(Int<F>(texels)) - to_float<F>(Int<F>(axis.first));
        const F scale(static_cast<Scalar<F>>(blocks) / static_cast<Scalar<F>>(axis.count));
        const F at = from_first * scale - F(0.5f);
        return axis.periodic ? repeated(at, blocks) : clamped(at, blocks);
    }
};

/// A table of distances as read along rays of a direction each. Directions flatter than the table's
/// are read as the nearest that it has, and coordinates outside of a map that does not repeat as
/// the nearest inside.
template <TextureSlot slot, class Io>
class DistanceTable {
  public:
    using F = typename Io::Number;
    /// Bilinear look-ups that one of the table takes: four directions, two layers.
    static constexpr int fetches = 8;

    DistanceTable(const Io& io, const vec2<F>& K)
        : io_(io),
          map_(io.template texture<TextureSlot::height>()->view),
          table_(io.template texture<slot>()->view),
          grid_(texel_grid(map_.width[0], map_.height[0],
                           io.template texture<TextureSlot::height>()->sampler)) {
        const vec2<F> at = square_of_direction(K / table_.depth());
        const F half(static_cast<Scalar<F>>(table_.directions() - 1) / 2);
        a_ = TablePlace<F>::clamped((at.x + F(1)) * half, table_.directions());
        b_ = TablePlace<F>::clamped((at.y + F(1)) * half, table_.directions());
    }

    const DirectionTable<F>& table() const { return table_; }

    /// How far it is along the ray from a place in texture space, as s counts; `layer` counts
    /// layers, of which parts are between two. Out of line: a search has one copy.
    [[gnu::noinline]] F fall(Mask<F> active, const vec2<F>& uv, F layer) const {
        const SampleContext<F> context = io_.template context<slot>(active);
        for (int n = 0; n < fetches; ++n) count_fetch(context);
        const auto i = TablePlace<F>::of_coordinate(uv.x, map_.width[0], grid_.u, table_.columns());
        const auto j = TablePlace<F>::of_coordinate(uv.y, map_.height[0], grid_.v, table_.rows());
        const auto k = TablePlace<F>::clamped(layer, table_.slices());
        F layers[2];
        for (int n = 0; n < 2; ++n) {
            F directions[4];
            for (int m = 0; m < 4; ++m)
                directions[m] =
                    at_place(i, j, n == 0 ? k.low : k.high, m % 2 == 0 ? a_.low : a_.high,
                             m / 2 == 0 ? b_.low : b_.high);
            layers[n] = lerp(lerp(directions[0], directions[1], a_.part),
                             lerp(directions[2], directions[3], a_.part), b_.part);
        }
        return lerp(layers[0], layers[1], k.part);
    }

  private:
    F at_place(const TablePlace<F>& i, const TablePlace<F>& j, Int<F> k, Int<F> a, Int<F> b) const {
        const auto row = [&](Int<F> y) {
            return lerp(table_.at(i.low, y, k, a, b), table_.at(i.high, y, k, a, b), i.part);
        };
        return lerp(row(j.low), row(j.high), j.part);
    }

    const Io& io_;
    const TextureView& map_;
    DirectionTable<F> table_;
    Grid grid_;
    TablePlace<F> a_, b_;
};

}  // namespace quadrel
