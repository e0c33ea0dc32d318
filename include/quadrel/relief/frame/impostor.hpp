// frame-impostor: the frame of the volume behind a card that faces the camera.
//
// Source: E. Risser, "True Impostors", GPU Gems 3, 2007, chapter 21: the view ray is taken into the
// space of the layers, whose frame has the middle of the quad for its origin. T, B and the normal
// are the object's axes, J the gradients of u and v in the whole of space. What is depth for other
// frames is here the way along the view ray, r = 1: a ray may go along the layers or come from
// behind them.
//
// Takes an object whose transform keeps angles, and a card whose UV do. NOFRAME where these are
// degenerate.
#pragma once

#include "quadrel/relief/impostor.hpp"

namespace quadrel {

struct FrameImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-impostor", "frame",
                                    "the axes of a volume behind a card that faces the camera",
                                    "Risser 2007, GPU Gems 3, chapter 21"};
    static constexpr auto inputs = impostor_inputs;
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ImpostorVolume<F> volume = impostor_volume(io);
        const vec3<F> d = -to_viewer(io.template load<Value::P>(), io.frame());
        const vec2<F> rate(dot(volume.grad_u, d), dot(volume.grad_v, d));
        io.template store<Value::T>(volume.x);
        io.template store<Value::B>(volume.y);
        io.template store<Value::frame_normal>(volume.z);
        io.template store<Value::J>(std::array<vec3<F>, 2>{volume.grad_u, volume.grad_v});
        io.template store<Value::r>(F(1));
        io.template store<Value::uv_rate>(rate);
        io.template store<Value::K>(rate * io.template load<Value::relief_depth>());
        io.template store<Value::frame_status>(select(volume.valid, status_packet<F>(Status::hit),
                                                      status_packet<F>(Status::no_frame)));
        io.template store<Value::frame_flags>(
            select(volume.valid, Int<F>(0), Int<F>(HitFlag::uv_degenerate)));
    }
};

}  // namespace quadrel
