// frame-thesis: the derivative frame of the thesis, as published.
//
// Source: "Derivative-Based Relief Mapping" (2012), appendix, Parallax.frag, section 1.
// T and B are the unit window-space tangents dP/dx and dP/dy. They are not perpendicular in
// general, so the UV shift is scaled by 1 +- cos(T, B) (the thesis' own account of this error,
// "derivatives are inaccurate", is not the cause). frame-gram is the corrected form.
// Where the listing has a zero or NaN derivative, so has this; a degenerate UV map is flagged.
// Under a parallel projection the listing still has the eye at the origin of eye space; this has
// the view direction.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// The listing's tangents and the UV rates along them.
template <Number F>
struct ThesisTangents {
    vec3<F> T, B;          ///< unit window-space tangents
    vec3<F> N_flat;        ///< unit normal of the flat face, on the side of the vertex normal
    vec2<F> dUVdT, dUVdB;  ///< UV a world unit along T and B
};

template <Number F>
ThesisTangents<F> thesis_tangents(const vec3<F>& dPdx, const vec3<F>& dPdy, const vec2<F>& dUVdx,
                                  const vec2<F>& dUVdy, const vec3<F>& surface_normal) {
    ThesisTangents<F> t;
    t.T = normalize(dPdx);
    t.B = normalize(dPdy);
    t.N_flat = normalize(cross(t.T, t.B));
    t.N_flat = select(dot(t.N_flat, surface_normal) < F(0), t.N_flat * F(-1), t.N_flat);
    t.dUVdT = dUVdx / length(dPdx);
    t.dUVdB = dUVdy / length(dPdy);
    return t;
}

/// The view ray below the surface, scaled to unit depth along N (SSR), and its part along the
/// surface (SR).
template <Number F>
struct SubSurfaceRay {
    vec3<F> SSR, SR;
};

template <Number F>
SubSurfaceRay<F> sub_surface_ray(const vec3<F>& E, const vec3<F>& N) {
    SubSurfaceRay<F> ray;
    ray.SSR = (-E) / dot(-N, -E);
    ray.SR = ray.SSR + N * dot(-N, ray.SSR);
    return ray;
}

struct FrameThesis : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "frame-thesis", "frame", "derivative frame of the thesis, unorthogonalised tangents",
        "Derivative-Based Relief Mapping (2012), appendix, Parallax.frag 1"};
    static constexpr const char* not_reproduced =
        "under a parallel projection: the view direction for the vector to the origin";
    static constexpr auto inputs = values(Value::P, Value::vertex_normal, Value::dPdx, Value::dPdy,
                                          Value::dUVdx, Value::dUVdy, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> surface_normal = io.template load<Value::vertex_normal>();
        const auto t = thesis_tangents<F>(
            io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
            io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>(), surface_normal);
        const vec3<F> E = to_viewer(P, io.frame());
        const vec3<F> N = normalize(surface_normal);
        const auto ray = sub_surface_ray(E, N);
        const vec2<F> dUVdSR = t.dUVdT * dot(ray.SR, t.T) + t.dUVdB * dot(ray.SR, t.B);

        io.template store<Value::T>(t.T);
        io.template store<Value::B>(t.B);
        io.template store<Value::frame_normal>(N);
        const vec3<F> grad_u = t.T * t.dUVdT.x + t.B * t.dUVdB.x;
        const vec3<F> grad_v = t.T * t.dUVdT.y + t.B * t.dUVdB.y;
        io.template store<Value::J>(std::array<vec3<F>, 2>{grad_u, grad_v});
        io.template store<Value::r>(dot(-N, -E));
        io.template store<Value::uv_rate>(dUVdSR);
        io.template store<Value::K>(dUVdSR * io.template load<Value::relief_depth>());
        io.template store<Value::frame_status>(status_packet<F>(Status::hit));
        io.template store<Value::frame_flags>(select(gradients_degenerate(grad_u, grad_v),
                                                     Int<F>(HitFlag::uv_degenerate), Int<F>(0)));
    }
};

}  // namespace quadrel
