// occlusion-none: nothing takes ambient light away.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct OcclusionNone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"occlusion-none", "occlusion", "ambient light everywhere", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs = occlusion_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::occlusion>(typename Io::Number(1));
    }
};

}  // namespace quadrel
