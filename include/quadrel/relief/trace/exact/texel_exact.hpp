// texel-exact: every dual cell that the ray crosses, its bilinear patch met exactly.
//
// No source's search does this: steps in depth or in texels miss patches that the ray enters and
// leaves between two of them. Finds the first point of the ray at or below the surface up to
// rounding; where rounding could decide between two surfaces the hit is flagged ambiguous.
// Cells: Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987,
// without its accumulation.
#pragma once

#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

struct TexelExact : PatchTrace {
    static constexpr StageText text{"texel-exact", "trace",
                                    "every cell on the way, its bilinear patch met exactly",
                                    "after Amanatides and Woo 1987; Ramsey et al. 2004"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        for (const auto k : rounds<F>()) {
            search.count_step(1, 2);
            if (none(search.active)) break;
            const CellExit<F> exit = search.exit(search.cell());
            search.test(search.active, exit);
            search.step(search.active, exit);
        }
        search.store();
    }
};

}  // namespace quadrel
