// clip-uv: a hit outside of a rectangle of texture space is not there.
//
// Source: F. Policarpo and M. Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems 3,
// 2007, chapter 18, program on the disc (border_clamp: alpha 0 outside of the tile); also the edge
// discard of most parallax shaders. Fragments with status CLIP are demoted, as by `discard`.
// Meant for one bounded polygon: the displaced coordinates are compared before any wrapping.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

/// The rectangle of texture space that a clipping stage keeps, ends included.
struct ClipParams {
    float u_min = 0, u_max = 1, v_min = 0, v_max = 1;
};
inline constexpr std::array clip_parameters{
    parameter<&ClipParams::u_min>("u_min", "UV", "least u that is kept", -1e6, 1e6, 0),
    parameter<&ClipParams::u_max>("u_max", "UV", "largest u that is kept", -1e6, 1e6, 1),
    parameter<&ClipParams::v_min>("v_min", "UV", "least v that is kept", -1e6, 1e6, 0),
    parameter<&ClipParams::v_max>("v_max", "UV", "largest v that is kept", -1e6, 1e6, 1)};

template <Number F>
Mask<F> inside_clip(const ClipParams& keep, const vec2<F>& uv) {
    return (uv.x >= F(keep.u_min)) & (uv.x <= F(keep.u_max)) & (uv.y >= F(keep.v_min)) &
           (uv.y <= F(keep.v_max));
}

struct ClipUv : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"clip-uv", "clip", "demotes hits outside of a UV rectangle",
                                    "Policarpo and Oliveira 2007, GPU Gems 3, chapter 18"};
    static constexpr auto inputs = values(Value::hit_uv, Value::hit_status);
    static constexpr auto outputs = values(Value::hit_status);
    using Params = ClipParams;
    static constexpr auto parameters = clip_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const Mask<F> inside = inside_clip<F>(params, io.template load<Value::hit_uv>());
        io.template store<Value::hit_status>(
            select(inside, io.template load<Value::hit_status>(), status_packet<F>(Status::clip)));
    }
};

}  // namespace quadrel
