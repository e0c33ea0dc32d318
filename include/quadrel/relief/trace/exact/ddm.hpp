// ddm: leaps by a directional distance map. For a block of cells, a slice of heights and a range of
// directions the map has the height down to which no ray of that range can meet the surface,
// wherever in the block and slice it is; where it may meet it within its cell, the bilinear patch
// is met exactly.
//
// After R. Mehra, S. Kumar, "Accurate and Efficient Rendering of Detail using Directional Distance
// Maps", ICVGIP 2012, of which the abstract could be read: sphere tracing aided by distance maps
// that depend on the direction, and intersections found analytically. Of one's own: the square of
// directions (direction_table.hpp); distances as the height where they end, from the top of the
// slice, so that none is lost below it; ranges of directions and blocks are bounded as a whole, so
// that leaps are safe. The source compresses its maps without loss; here they are plain. Rays
// flatter than the square of directions, and those whose position is known to less than a 64th of
// a cell, walk from cell to cell. The same hits as texel-exact, bit for bit, for heights in [0, 1].
#pragma once

#include "quadrel/relief/direction_table.hpp"
#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

/// The map as read along rays of a direction each.
template <class Io>
class DirectionalDistances {
  public:
    using F = typename Io::Number;

    DirectionalDistances(const Io& io, const PatchSearch<Io>& search)
        : table_(io.template texture<TextureSlot::ddm>()->view), grid_(search.grid()) {
        // Of a ray that is not searched, 0.
        const TextureView& map = search.map().view;
        const vec2<F> size(to_float<F>(Int<F>(map.width[0])), to_float<F>(Int<F>(map.height[0])));
        const vec2<F> K(search.ray.x.rate / size.x, search.ray.y.rate / size.y);
        const vec2<F> at = square_of_direction(K / table_.depth());
        const F side = to_float<F>(Int<F>(table_.directions()));
        const auto range = [&](F x) {
            const F place = (x * F(0.5f) + F(0.5f)) * side;
            return to_int(clamp(floor(place), F(0), side - F(1)));
        };
        a_ = range(at.x);
        b_ = range(at.y);
        const F slack = max(search.ray.x.slack, search.ray.y.slack);
        holds_ = (max(abs(at.x), abs(at.y)) <= F(1)) & (slack < F(1.0f / 64));
    }

    /// Whether the map has a ray's direction; its position has to be known well, too.
    Mask<F> holds() const { return holds_; }

    /// The height down to which a ray at height z in the search's cell meets nothing; 1 where the
    /// map does not tell.
    F free_down_to(const PatchSearch<Io>& search, F z) const {
        const Int<F> i = block(search.stored_i(), grid_.u, table_.columns());
        const Int<F> j = block(search.stored_j(), grid_.v, table_.rows());
        return select(holds_, table_.at(i, j, table_.slice(z), a_, b_), F(1));
    }

  private:
    /// No quotient is nearer to a whole number than half a cell in a block's.
    static Int<F> block(Int<F> stored, const GridAxis& axis, std::int32_t blocks) {
        const F side = to_float<F>(Int<F>(block_side(axis.count, blocks)));
        return to_int(floor((to_float<F>(stored) + F(0.5f)) / side));
    }

    DirectionTable<F> table_;
    Grid grid_;
    Int<F> a_, b_;  ///< the range of each ray's direction
    Mask<F> holds_;
};

struct Ddm : PatchTrace {
    static constexpr StageText text{"ddm", "trace",
                                    "leaps by free distances per direction, patches exact",
                                    "after Mehra and Kumar 2012"};
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::ddm);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const DirectionalDistances<Io> distances(io, search);
        F s(0);
        for (const auto k : rounds<F>()) {
            search.count_step(2, 2);
            if (none(search.active)) break;
            const Mask<F> active = search.active;
            s = max(s, search.entry());
            const F free = distances.free_down_to(search, F(1) - s);
            search.template record_node<TextureSlot::ddm>(active & distances.holds(), free);
            const CellExit<F> exit = search.exit(search.cell());
            const F bound = free + search.ray.margin;
            const Mask<F> tests = active & !(F(1) - min(exit.s, F(1)) > bound);
            if (when(tests)) search.test(tests, exit);
            const F to = F(1) - bound;
            const Mask<F> leaps = to > exit.s;
            search.leap_to(search.active & leaps, to);
            search.step(search.active & !leaps, exit);
            s = select(leaps, to, s);
        }
        search.store();
    }
};

}  // namespace quadrel
