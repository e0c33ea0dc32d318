// h2n-thesis@published: the normal of the thesis from four height samples, as published.
//
// Source: "Derivative-Based Relief Mapping" (2012), appendix, Parallax.frag, "Recalculate the
// normal based surface differences". Defects kept: the samples lie a fixed world distance (1/128)
// apart, whatever a texel is; the cross product of the unoriented tangents may come out reversed,
// and the difference to the vertex normal is added before the side is chosen; the sum is not
// normalised.
#pragma once

#include "quadrel/relief/frame/thesis.hpp"

namespace quadrel {

struct H2nThesisPublished : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "h2n-thesis@published", "surface", "normal from four heights 1/128 world units apart",
        "Derivative-Based Relief Mapping (2012), appendix, Parallax.frag 1"};
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy,
               Value::relief_depth, Value::hit_uv, Value::hit_depth);
    static constexpr bool needs_height_map = true;

    static constexpr float offset_per_sample = 1.0f / 128.0f;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> surface_normal = io.template load<Value::vertex_normal>();
        const auto t = thesis_tangents<F>(
            io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
            io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>(), surface_normal);
        const vec3<F> N0 = normalize(surface_normal);
        const auto ray = sub_surface_ray(to_viewer(P, io.frame()), N0);
        const vec3<F> SP = P + ray.SR * io.template load<Value::hit_depth>();
        const vec2<F> UV = io.template load<Value::hit_uv>();
        const F step(offset_per_sample), scalar = io.template load<Value::relief_depth>();
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const auto depth = [&](const vec2<F>& uv) {
            return F(1) - texture(map, io.template context<TextureSlot::height>(), uv,
                                  io.frame().derivatives)
                              .x;
        };

        const F H1 = depth(UV + t.dUVdT * step);
        const F H2 = depth(UV - t.dUVdT * step);
        const F H3 = depth(UV + t.dUVdB * step);
        const F H4 = depth(UV - t.dUVdB * step);
        const vec3<F> P1 = SP + t.T * step + (-N0) * (scalar * H1);
        const vec3<F> P2 = SP - t.T * step + (-N0) * (scalar * H2);
        const vec3<F> P3 = SP + t.B * step + (-N0) * (scalar * H3);
        const vec3<F> P4 = SP - t.B * step + (-N0) * (scalar * H4);
        const vec3<F> T = normalize(P1 - P2), B = normalize(P3 - P4);
        vec3<F> N = normalize(cross(T, B));
        N = N + (normalize(surface_normal) - normalize(t.N_flat));
        io.template store<Value::N>(
            select(dot(normalize(N), normalize(surface_normal)) < F(0), N * F(-1), N));
    }
};

}  // namespace quadrel
