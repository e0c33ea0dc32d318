// What searches of cells tell of their look-ups: how many there are, and what a probe sees of them.
#pragma once

#include "quadrel/relief/trace/exact/cell_search.hpp"
#include "quadrel/relief/trace/exact/patch.hpp"

namespace quadrel {

/// Look-ups in a map that was baked for the search, which gave `height` for where the rays are.
template <TextureSlot slot, int fetches = 1, class Io, Number F>
void record_node(const Io& io, CellSearch<F>& search, const SearchRay<F>& fragment, Mask<F> mask,
                 F height) {
    const SampleContext<F> context = io.template context<slot>(mask);
    for (int k = 0; k < fetches; ++k) {
        count_fetch(context);
        count_in<F>(search.result.fetches, mask);
    }
    if (context.log == nullptr) return;
    const F s = search.entry();
    io.march_step(mask, s, fragment.at(s), F(1) - s, height);
}

/// The texels of a cell, whose patch is at `height` where the ray enters it.
template <TextureSlot slot, class Io, Number F>
void record_cell(const Io& io, CellSearch<F>& search, const SearchRay<F>& fragment,
                 const SampledTexture& map, Mask<F> mask, F s, const CellHeights<F>& texels,
                 F height) {
    const SampleContext<F> context = io.template context<slot>(mask);
    count_fetch(context);
    count_in<F>(search.result.fetches, mask);
    const vec2<F> uv = fragment.at(s);
    io.march_step(mask, s, uv, F(1) - s, height);
    if (context.log == nullptr) return;
    log_fetch(context, map, uv, lod_from_level(map, F(0)),
              vec4<F>(texels.h00, texels.h10, texels.h01, texels.h11));
}

}  // namespace quadrel
