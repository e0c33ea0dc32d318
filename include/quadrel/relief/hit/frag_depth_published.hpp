// frag-depth@published: the depth that McGuire and McGuire suggest to write.
//
// Source: M. McGuire and M. McGuire, "Steep Parallax Mapping", 2005 poster page: gl_FragDepth is 1
// over the sum of the surface's depth and the distance along the ray. Kept as it is: it is no
// depth of the projection, grows towards the eye, and does not compare with other geometry's.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct FragDepthPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frag-depth@published", "frag-depth",
                                    "1 / (eye-space depth + distance along the ray)",
                                    "McGuire and McGuire 2005, Steep Parallax Mapping"};
    static constexpr auto inputs = values(Value::P, Value::r, Value::hit_depth);
    static constexpr auto outputs = values(Value::frag_depth);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const F z = -io.template load<Value::P>().z;
        const F along = io.template load<Value::hit_depth>() / io.template load<Value::r>();
        io.template store<Value::frag_depth>(F(1) / (z + along));
    }
};

}  // namespace quadrel
