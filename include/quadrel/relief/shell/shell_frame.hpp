// What the frames of shells store: an affine texture space around the point where a ray enters.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

inline constexpr ValueName shell_normal_names[] = {{0, "vertex"}, {1, "level"}};

/// A frame of the rows that a shell's faces have.
struct ShellFrame : StageDefaults {
    static constexpr auto inputs = values(Value::P, Value::vertex_normal, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
    static constexpr bool reads_vertices = true;
    struct Params {
        std::int32_t normal = 0;
    };
    static constexpr std::array parameters{choice<&Params::normal>(
        "normal", "vertex: interpolated, smooth; level: across the planes of equal height",
        shell_normal_names, 0)};
};

/// Everything is measured along the ray: r = 1, uv_rate = J d. `s_gradient`: of the depth below
/// the shell's top.
template <class Io, class F = typename Io::Number>
void store_shell_frame(const Io& io, const vec3<F>& grad_u, const vec3<F>& grad_v,
                       const vec3<F>& s_gradient, const ShellFrame::Params& params) {
    const vec3<F> d = -to_viewer(io.template load<Value::P>(), io.frame());
    const F depth = io.template load<Value::relief_depth>();
    const Mask<F> yes(true), deep = depth > F(0);
    const SurfaceJacobian<F> j{grad_u, grad_v, yes, gradients_degenerate(grad_u, grad_v)};
    const vec2<F> rate(dot(j.grad_u, d), dot(j.grad_v, d));
    const auto directions = uv_directions(j);
    io.template store<Value::T>(directions.T);
    io.template store<Value::B>(directions.B);
    const vec3<F> smooth = normalize(io.template load<Value::vertex_normal>());
    const vec3<F> level = select(deep, s_gradient * -depth, smooth);
    io.template store<Value::frame_normal>(params.normal == 0 ? smooth : level);
    io.template store<Value::J>(std::array<vec3<F>, 2>{j.grad_u, j.grad_v});
    io.template store<Value::r>(F(1));
    io.template store<Value::uv_rate>(rate);
    io.template store<Value::K>(rate * depth);
    io.template store<Value::frame_status>(status_packet<F>(Status::hit));
    io.template store<Value::frame_flags>(
        select(j.uv_degenerate, Int<F>(HitFlag::uv_degenerate), Int<F>(0)));
}

}  // namespace quadrel
