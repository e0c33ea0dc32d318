// trace-none: no search; the surface is the polygon.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct TraceNone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"trace-none", "trace", "no search: the undisplaced UV", "-"};
    static constexpr auto inputs = values(Value::uv, Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const F seat(io.material().seat);
        io.template store<Value::hit_uv>(io.template load<Value::uv>());
        io.template store<Value::hit_s>(F(1) - seat);
        io.template store<Value::hit_h>(seat);
        io.template store<Value::hit_depth>(F(0));
        io.template store<Value::hit_status>(io.template load<Value::frame_status>());
        io.template store<Value::hit_flags>(io.template load<Value::frame_flags>());
        io.template store<Value::hit_steps>(Int<F>(0));
        io.template store<Value::hit_fetches>(Int<F>(0));
    }
};

}  // namespace quadrel
