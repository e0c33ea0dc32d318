// multilayer-exact: four depth layers, met exactly: four quadratics a cell, upwards through odd
// layers and downwards through even ones.
//
// No source's search does this; the pyramid is that of Oh, Ki, Lee, "Pyramidal Displacement
// Mapping", VRST 2006, of maxima of odd layers and minima of even ones. As dual-depth-exact, for
// two solids above each other. Layers must be sorted: a pair whose back lies before its front is
// empty.
#pragma once

#include "quadrel/relief/trace/layer/layer_pyramid.hpp"

namespace quadrel {

struct MultilayerExact : ExactLayers<4> {
    static constexpr StageText text{"multilayer-exact", "trace",
                                    "four patches of every cell on the way, exactly",
                                    "after Ramsey et al. 2004; Oh, Ki, Lee 2006"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        search(io);
    }
};

}  // namespace quadrel
