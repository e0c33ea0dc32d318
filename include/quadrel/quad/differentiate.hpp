// differentiate: window-space differences of the surface point and of the texture coordinates.
#pragma once

#include "quadrel/quad/stage.hpp"

namespace quadrel {

struct Differentiate : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"differentiate", "quad",
                                    "dFdx and dFdy of position and texture coordinates",
                                    "Vulkan specification, derivative operations"};
    static constexpr auto inputs = values(Value::P, Value::uv);
    static constexpr auto outputs = values(Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        const auto mode = io.frame().derivatives;
        const auto P = io.template load<Value::P>();
        const auto uv = io.template load<Value::uv>();
        io.template store<Value::dPdx>(dFdx(P, mode));
        io.template store<Value::dPdy>(dFdy(P, mode));
        io.template store<Value::dUVdx>(dFdx(uv, mode));
        io.template store<Value::dUVdy>(dFdy(uv, mode));
    }
};

}  // namespace quadrel
