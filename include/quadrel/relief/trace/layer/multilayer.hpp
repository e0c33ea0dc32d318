// multilayer: relief mapping of four sorted depths: inside where an odd number of them is passed.
//
// Source: F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D
// 2006: a linear search for the first sample inside, then bisection, both by parity. Corrects
// multilayer@published: that starts half of the shift ahead of the UV, scales the depth by the
// angle of view, searches from the bottom up where a face is seen from behind, has no bracket to
// halve and takes s outside of [0.003, 0.997] for a miss. Misses what is thinner along the ray than
// |K| / steps; at most 2^-binary_steps / steps late, never early.
#pragma once

#include "quadrel/relief/trace/layer/march_layers.hpp"

namespace quadrel {

struct Multilayer : MarchOfLayers<4> {
    static constexpr StageText text{"multilayer", "trace",
                                    "linear search and bisection by parity through four depths",
                                    "Policarpo and Oliveira 2006"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        march(io, params);
    }
};

}  // namespace quadrel
