// frame-none: no relief. The normal is the interpolated one on the viewer's side; nothing shifts.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct FrameNone : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-none", "frame", "no frame: plain texturing", "-"};
    static constexpr auto inputs = values(Value::P, Value::vertex_normal, Value::Ng);
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        const vec3<F> N = normalize(io.template load<Value::vertex_normal>());
        const vec3<F> zero(F(0));
        io.template store<Value::T>(zero);
        io.template store<Value::B>(zero);
        io.template store<Value::frame_normal>(
            select(dot(io.template load<Value::Ng>(), V) < F(0), -N, N));
        io.template store<Value::J>(std::array<vec3<F>, 2>{zero, zero});
        io.template store<Value::r>(F(1));
        io.template store<Value::uv_rate>(vec2<F>(F(0)));
        io.template store<Value::K>(vec2<F>(F(0)));
        io.template store<Value::frame_status>(status_packet<F>(Status::hit));
        io.template store<Value::frame_flags>(Int<F>(0));
    }
};

}  // namespace quadrel
