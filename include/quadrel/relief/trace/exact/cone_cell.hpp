// cone-cell: a cone map over dual cells that is exact for the bilinear field. A cell Q has its
// greatest height M and the ratio c = min over higher cells R of distance(Q, R) / (M_R - M); a ray
// at height z above M can fall by c (z - M) / (c + |K|) before it can meet anything.
//
// Corrects cone-step (Dummer, "Cone Step Mapping", 2006), whose cones stand on texel centres, are
// interpolated, and let the bilinear surface between two centres through: ratios are between whole
// cells and read by cell, and a cell that the ray comes down to is met exactly. The same hits as
// texel-exact, bit for bit, for heights in [0, 1].
#pragma once

#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

/// {M, c} of the cells where the rays are.
template <Number F>
struct CellCone {
    F height, ratio;
};

template <class Io, class F = typename Io::Number>
CellCone<F> cell_cone(const Io& io, const PatchSearch<Io>& search) {
    const TextureView& view = io.template texture<TextureSlot::cone_cell>()->view;
    const vec2<F> cone = both_channels<F>(view, search.stored_i(), search.stored_j());
    return {cone.x, cone.y};
}

struct ConeCell : PatchTrace {
    static constexpr StageText text{"cone-cell", "trace",
                                    "leaps by cones between whole cells, patches exact",
                                    "correction of cone-step; after Dummer 2006"};
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::cone_cell);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const F kappa = length(search.fragment().K);
        F s(0);
        for (const auto k : rounds<F>()) {
            search.count_step(2, 2);
            if (none(search.active)) break;
            const Mask<F> active = search.active;
            const CellCone<F> cone = cell_cone(io, search);
            search.template record_node<TextureSlot::cone_cell>(active, cone.height);
            s = max(s, search.entry());
            const CellExit<F> exit = search.exit(search.cell());
            const F bound = cone.height + search.ray.margin;
            const Mask<F> tests = active & !(F(1) - min(exit.s, F(1)) > bound);
            if (when(tests)) search.test(tests, exit);
            const F gap = (F(1) - s) - bound;
            const F to = s + cone.ratio * gap / (cone.ratio + kappa);
            const Mask<F> leaps = (gap > F(0)) & (to > exit.s);
            search.leap_to(search.active & leaps, to);
            search.step(search.active & !leaps, exit);
            s = select(leaps, to, s);
        }
        search.store();
    }
};

}  // namespace quadrel
