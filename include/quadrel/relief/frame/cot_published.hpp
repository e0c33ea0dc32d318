// frame-cot@published: the scale-invariant cotangent frame, as published.
//
// Source: C. Schueler, "Followup: Normal Mapping Without Precomputed Tangents", 2013, listing
// cotangent_frame. T and B are the rows of frame-cot without 1 / det, both divided by the longer
// one's length. The publication bends normals with them; parallax shaders built on it take the view
// vector along the frame's axes, V_t = (V.T, V.B, V.N), and shift by
//     K = -Du V_t.xy / V_t.z,  Du the material's depth, a length in UV (published.hpp).
// Directions and ratios are right for every map; the unit of depth is not the world's but the
// tile's length along the longest gradient. Where window y points down, det < 0 and the shift turns
// round.
#pragma once

#include "quadrel/relief/frame/cot.hpp"
#include "quadrel/relief/frame/published.hpp"

namespace quadrel {

/// Columns of the matrix that the listing returns, before N.
template <Number F>
UvDirections<F> scale_invariant_frame(const CotangentRows<F>& rows) {
    const F invmax = inversesqrt(max(dot(rows.T, rows.T), dot(rows.B, rows.B)));
    return {rows.T * invmax, rows.B * invmax};
}

struct FrameCotPublished : DerivativeFrame {
    static constexpr StageText text{"frame-cot@published", "frame",
                                    "scale-invariant cotangent frame, as listed",
                                    "Schueler, Normal Mapping Without Precomputed Tangents, 2013"};
    static constexpr const char* not_reproduced =
        "K is no part of the listing, which bends normals alone";

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const vec3<F> N = normalize(io.template load<Value::vertex_normal>());
        const auto axes = scale_invariant_frame(
            cotangent_rows(io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
                           io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>(), N));
        const vec3<F> V_t(dot(surface.V, axes.T), dot(surface.V, axes.B), dot(surface.V, N));
        const vec2<F> K = -(vec2<F>(V_t.x, V_t.y) * F(io.material().depth)) / V_t.z;
        const Mask<F> yes(true);
        store_published_frame(io, axes, surface.N, SurfaceJacobian<F>{axes.T, axes.B, yes, !yes},
                              V_t.z, K);
    }
};

}  // namespace quadrel
