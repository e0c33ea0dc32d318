// dual-depth: relief mapping of a front and a back depth: rays that pass behind the back miss.
//
// Source: the dual-depth relief maps of F. Policarpo, M. M. Oliveira, J. L. D. Comba, "Real-Time
// Relief Mapping on Arbitrary Polygonal Surfaces", I3D 2005. Corrects dual-depth@published: the
// linear search asks for the back depth, too, so that what lies behind does not look solid; the
// bisection keeps the bracket that the search has found; the top and the bottom plane are tested; a
// ray that meets nothing is no hit. Misses what is thinner along the ray than |K| / steps: a sheet
// has holes then. At most 2^-binary_steps / steps late, never early.
#pragma once

#include "quadrel/relief/trace/layer/march_layers.hpp"

namespace quadrel {

struct DualDepth : MarchOfLayers<2> {
    static constexpr StageText text{"dual-depth", "trace",
                                    "linear search and bisection between front and back depth",
                                    "Policarpo, Oliveira, Comba 2005"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        march(io, params);
    }
};

}  // namespace quadrel
