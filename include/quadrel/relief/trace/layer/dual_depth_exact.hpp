// dual-depth-exact: the solid between a front and a back depth, met exactly: two quadratics a cell.
//
// No source's search does this; steps in depth miss sheets that are thinner than they. Finds the
// first point of the ray with front <= s < back up to rounding, through the front or from the side;
// where rounding could decide between surfaces the hit is flagged ambiguous. A ray that meets
// nothing is a miss, CLIP. Cells that lie before or behind all of the solid are left by a pyramid
// (layer_pyramid.hpp).
#pragma once

#include "quadrel/relief/trace/layer/layer_pyramid.hpp"

namespace quadrel {

struct DualDepthExact : ExactLayers<2> {
    static constexpr StageText text{"dual-depth-exact", "trace",
                                    "front and back patches of every cell on the way, exactly",
                                    "after Ramsey et al. 2004; Oh, Ki, Lee 2006"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        search(io);
    }
};

}  // namespace quadrel
