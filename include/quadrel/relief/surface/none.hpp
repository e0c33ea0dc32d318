// surface-none: the shading normal is the frame's.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct SurfaceNone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"surface-none", "surface", "the frame's normal", "-"};
    static constexpr auto inputs = values(Value::frame_normal);
    static constexpr auto outputs = surface_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::N>(io.template load<Value::frame_normal>());
    }
};

}  // namespace quadrel
