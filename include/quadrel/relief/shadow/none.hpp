// shadow-none: every light reaches every point.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct ShadowNone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-none", "shadow", "no self-shadowing", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs = shadow_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        io.template store<Value::shadow_visibility>(F(1), io.light());
        io.template store<Value::shadow_steps>(Int<F>(0), io.light());
    }
};

}  // namespace quadrel
