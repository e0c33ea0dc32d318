// qdm: quadtree displacement mapping, exact for the field of blocks.
//
// Source: Drobot, "Quadtree Displacement Mapping with Height Blending", GPU Pro, 2010: a pyramid of
// the texels' heights, gone down where the ray comes below a node's, and up again after a border
// has been crossed. Corrects qdm@published: the next node follows from integers, where the source
// adds half a texel so as to be surely across and so misses what is thinner; no cap; no smoothing
// of the hit between two samples around it, which moves it across edges. Up one level after each
// border (the source's default keeps the level, which is 0 here; its variants go up one or two).
#pragma once

#include "quadrel/relief/trace/exact/block_search.hpp"

namespace quadrel {

struct Qdm : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"qdm", "trace",
                                    "pyramid of texel heights, exact for a field of blocks",
                                    "correction of qdm@published; Drobot 2010"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::texel_max);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;
    struct Params {
        std::int32_t ascent = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::ascent>("ascent", "levels", "levels up after a border", 0, 2, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        BlockSearch<Io> search(io);
        search.run(params.ascent);
    }
};

}  // namespace quadrel
