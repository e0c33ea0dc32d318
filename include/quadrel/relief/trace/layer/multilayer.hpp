// multilayer: relief mapping of four sorted depths: inside where an odd number of them is passed.
//
// Source: F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D
// 2006: a linear search for the first sample inside, then bisection, both by parity. Differs: the
// top and the bottom plane are tested, and a ray that meets nothing is no hit. Its listing could
// not be read, so that there is no row of it as published. Misses what is thinner along the ray
// than |K| / steps; at most 2^-binary_steps / steps late, never early.
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
