// frame-cot: the cotangent frame as J, oblique split.
//
// Source: C. Schueler, "Followup: Normal Mapping Without Precomputed Tangents", 2013. With window
// differences px, py of position and qx, qy of UV, and the unit normal N,
//     grad u = ((py x N) qx.u + (N x px) qy.u) / det,  likewise grad v,  det = N.(px x py).
// These solve grad u . px = qx.u, grad u . py = qy.u, grad u . N = 0: it is J with J N = 0, which
// splits vectors along N (split.hpp) and equals frame-gram where N is the face's normal.
// The published frame leaves out 1 / det and divides both rows by the longer one's length ("scale
// invariant"; frame-cot@published). That serves to bend normals, but loses the density of the UV
// map, which parallax needs, and the sign of det, so that it turns round where window y points
// down.
//
// NOFRAME as frame-gram, and where N lies in the face or behind it.
#pragma once

#include "quadrel/relief/frame/gram.hpp"

namespace quadrel {

/// The gradients before the division by det.
template <Number F>
struct CotangentRows {
    vec3<F> T, B;
};

template <Number F>
CotangentRows<F> cotangent_rows(const vec3<F>& px, const vec3<F>& py, const vec2<F>& qx,
                                const vec2<F>& qy, const vec3<F>& N) {
    const vec3<F> dual_x = cross(py, N), dual_y = cross(N, px);
    return {dual_x * qx.x + dual_y * qy.x, dual_x * qx.y + dual_y * qy.y};
}

template <Number F>
SurfaceJacobian<F> cotangent_jacobian(const vec3<F>& px, const vec3<F>& py, const vec2<F>& qx,
                                      const vec2<F>& qy, const vec3<F>& N) {
    const SurfaceJacobian<F> gram = gram_jacobian(px, py, qx, qy);
    const vec3<F> n = cross(px, py);
    const F det = dot(N, n);
    const CotangentRows<F> rows = cotangent_rows(px, py, qx, qy, N);
    const vec3<F> zero(F(0));
    SurfaceJacobian<F> j;
    j.valid = gram.valid & (abs(det) > degenerate_tolerance<F>() * length(n));
    j.grad_u = select(j.valid, rows.T / det, zero);
    j.grad_v = select(j.valid, rows.B / det, zero);
    j.uv_degenerate = gram.uv_degenerate;
    return j;
}

struct FrameCot : DerivativeFrame {
    static constexpr StageText text{"frame-cot", "frame",
                                    "cotangent frame with its length, oblique split",
                                    "Schueler, Normal Mapping Without Precomputed Tangents, 2013"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const vec3<F> px = io.template load<Value::dPdx>(), py = io.template load<Value::dPdy>();
        const F scale = ordinary_scale(px, py);
        SurfaceJacobian<F> j =
            cotangent_jacobian(px * scale, py * scale, io.template load<Value::dUVdx>(),
                               io.template load<Value::dUVdy>(), surface.N);
        j.grad_u = j.grad_u * scale;
        j.grad_v = j.grad_v * scale;
        store_frame(io, surface, j, oblique_depth_rate(surface, io.template load<Value::Ng>()));
    }
};

}  // namespace quadrel
