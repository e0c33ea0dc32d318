// clip-path: the ray must stay within a rectangle of texture space from the top plane to its hit.
//
// Differs from clip-uv where the polygon is not the top of the relief (seat < 1): there a ray may
// enter the relief's slab outside of the rectangle, cross its side, and hit inside. A rectangle is
// convex, so that both ends of the path decide.
#pragma once

#include "quadrel/relief/hit/clip_uv.hpp"

namespace quadrel {

struct ClipPath : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"clip-path", "clip",
                                    "demotes rays that leave a UV rectangle before their hit",
                                    "correction of clip-uv for relief above its polygon"};
    static constexpr auto inputs = values(Value::uv, Value::K, Value::hit_uv, Value::hit_status);
    static constexpr auto outputs = values(Value::hit_status);
    using Params = ClipParams;
    static constexpr auto parameters = clip_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const Scalar<F> s_polygon = Scalar<F>(1) - Scalar<F>(io.material().seat);
        const vec2<F> top =
            io.template load<Value::uv>() + io.template load<Value::K>() * F(-s_polygon);
        const Mask<F> inside =
            inside_clip<F>(params, top) & inside_clip<F>(params, io.template load<Value::hit_uv>());
        io.template store<Value::hit_status>(
            select(inside, io.template load<Value::hit_status>(), status_packet<F>(Status::clip)));
    }
};

}  // namespace quadrel
