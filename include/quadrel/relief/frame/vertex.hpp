// frame-vertex: tangents of the vertices, interpolated; the density of the UV map kept.
//
// Source: F. Policarpo, M. Oliveira and J. Comba, "Real-Time Relief Mapping on Arbitrary Polygonal
// Surfaces", 2005; T. Welsh, "Parallax Mapping with Offset Limiting", 2004 (listed in
// frame-vertex@published). The vertices carry dP/du and dP/dv, averaged over their triangles
// (scene/tangents.hpp); a fragment turns them into the plane of its normal, normalises them to T
// and B, and takes the rows of J as T / |dP/du| and B / |dP/dv|. Where the published programs
// normalise at once, the interpolated lengths stay as density, so that the relief is as deep as its
// depth says whatever the size of a tile. Vectors are split orthogonally, depth along N.
//
// Exact only where dP/du is perpendicular to dP/dv: the rows of J are the dual basis of dP/du and
// dP/dv, which T and B are not under shear. Mirrored maps are right because B is not a cross
// product. Where the UV map is degenerate the vertices have no tangents: K = 0, flagged.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// `v` in the plane of the unit vector N, normalised; null where nothing is left.
template <Number F>
vec3<F> tangent_direction(const vec3<F>& v, const vec3<F>& N) {
    const vec3<F> scaled = v * ordinary_scale(largest_component(v));
    const vec3<F> in_plane = scaled - N * dot(N, scaled);
    const F squared = dot(in_plane, in_plane);
    return select(squared > F(0), in_plane * inversesqrt(squared), vec3<F>(F(0)));
}

/// x / length, null where there is no length.
template <Number F>
vec3<F> over_length(const vec3<F>& x, F length) {
    return select(length > F(0), x / length, vec3<F>(F(0)));
}

struct FrameVertex : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-vertex", "frame",
                                    "interpolated vertex tangents, density kept",
                                    "Policarpo, Oliveira and Comba 2005; correction of Welsh 2004"};
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::vertex_tangent,
               Value::vertex_bitangent, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const vec3<F> dPdu = io.template load<Value::vertex_tangent>();
        const vec3<F> dPdv = io.template load<Value::vertex_bitangent>();
        const UvDirections<F> directions{tangent_direction(dPdu, surface.N),
                                         tangent_direction(dPdv, surface.N)};
        SurfaceJacobian<F> j;
        j.grad_u = over_length(directions.T, length_at_any_scale(dPdu));
        j.grad_v = over_length(directions.B, length_at_any_scale(dPdv));
        j.valid = Mask<F>(true);
        j.uv_degenerate = gradients_degenerate(j.grad_u, j.grad_v);
        store_frame(io, surface, j, directions, dot(surface.V, surface.N));
    }
};

}  // namespace quadrel
