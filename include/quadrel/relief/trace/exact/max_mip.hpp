// max-mip: nodes of a maximum pyramid over dual cells that lie below the ray are left in one step;
// where it comes down to a cell, the bilinear patch is met exactly.
//
// Source: Tevs, Ihrke, Seidel, "Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height
// Field Rendering", I3D 2008: up a level where the border crossed is one of the parent's. Differs:
// sizes need not be powers of two, all wrap modes, and the next node follows from integers and from
// the parameters of borders, not from a point that was computed. The same hits as texel-exact, bit
// for bit, for heights in [0, 1].
#pragma once

#include "quadrel/relief/trace/exact/height_pyramid.hpp"
#include "quadrel/relief/trace/exact/patch_search.hpp"

namespace quadrel {

struct MaxMip : PatchTrace {
    static constexpr StageText text{"max-mip", "trace",
                                    "nodes of a maximum pyramid left in one step, patches exact",
                                    "Tevs, Ihrke, Seidel 2008"};
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const HeightPyramid<F> pyramid(*io.template texture<TextureSlot::max_mip>(), search.grid());
        search_pyramid<F>(
            search, pyramid, -1,
            [&](Mask<F> mask, const CellExit<F>& exit, F) { search.test(mask, exit); },
            [&](Mask<F> mask, F height) {
                search.template record_node<TextureSlot::max_mip>(mask, height);
            });
        search.store();
    }
};

}  // namespace quadrel
