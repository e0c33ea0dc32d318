// displace: where the hit lies in space. hit.P = P - (V / r) * depth, on the view ray.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct Displace : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"displace", "hit", "the hit as a point in eye space",
                                    "Derivative-Based Relief Mapping (2012), P + SSR * Offset"};
    static constexpr auto inputs = values(Value::P, Value::r, Value::hit_depth);
    static constexpr auto outputs = values(Value::hit_P);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> V = to_viewer(P, io.frame());
        const vec3<F> SSR = (-V) / io.template load<Value::r>();
        io.template store<Value::hit_P>(P + SSR * io.template load<Value::hit_depth>());
    }
};

}  // namespace quadrel
