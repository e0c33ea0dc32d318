// cone-robust-exact: cone steps where they leave the bilinear patch, the exact patch where not.
//
// Corrects cone-robust (Ban, Valasek, Balint, Vad, "Robust Cone Step Mapping", EGSR 2024), whose
// step to the patch's border misses a surface that is entered and left on the way: a patch that the
// cone step does not leave is met exactly. What remains late is where the surface pierces a cone
// between texel centres. Hits on patches have the bits of texel-exact.
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"
#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

struct ConeRobustExact : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"cone-robust-exact", "trace",
                                    "cone steps from patch to patch, patches exact",
                                    "correction of cone-robust; after Ban et al. 2024"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::cone_robust);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const BakedLookUp<TextureSlot::cone_robust, 2, Io> read(io);
        const F kappa = length(search.fragment().K);
        F s(0);
        for (const auto k : rounds<F>()) {
            search.count_step(2, 2);
            if (none(search.active)) break;
            const Mask<F> active = search.active;
            s = min(max(s, search.entry()), F(1));
            const auto texel = read(active, search.fragment().at(s));
            count_in<F>(search.result.fetches, active);
            io.march_step(active, s, search.fragment().at(s), F(1) - s, texel.channel[0]);
            const CellExit<F> exit = search.exit(search.cell());
            const F gap = (F(1) - s) - texel.channel[0];
            const F to = s + cone_step_length(gap, texel.channel[1], kappa);
            const Mask<F> leaps = (gap > F(0)) & (to > exit.s);
            search.test(active & !leaps, exit);
            search.leap_to(search.active & leaps, to);
            search.step(search.active & !leaps, exit);
            s = select(leaps, to, s);
        }
        search.store();
    }
};

}  // namespace quadrel
