// pyramid: pyramidal displacement mapping: down a pyramid of the texels' heights, from the top to
// the texels, never up again. Exact for the field of blocks.
//
// Source: Oh, Ki, Lee, "Pyramidal Displacement Mapping: A GPU based Artifacts-Free Ray Tracing
// through an Image Pyramid", VRST 2006. Differs: the hit is that of the block; the source then
// interpolates between texels where the map is magnified. Any size and wrap mode. The hits of qdm,
// bit for bit; more steps once the ray has been down and a long way is left.
#pragma once

#include "quadrel/relief/trace/exact/block_search.hpp"

namespace quadrel {

struct Pyramid : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"pyramid", "trace",
                                    "down a pyramid of texel heights, exact for a field of blocks",
                                    "after Oh, Ki, Lee 2006"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::texel_max);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        BlockSearch<Io> search(io);
        search.run(0);
    }
};

}  // namespace quadrel
