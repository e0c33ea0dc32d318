// frame-inverse-tbn: texture space by inverting the matrix of tangents.
//
// Corrects frame-inverse-tbn@published, which inverts a matrix of gradients: a direction d goes to
// texture space by the inverse of M = [dP/du, dP/dv, N],
//     (u, v, z) = M^-1 d,  K = D (u, v) / |z|.
// dP/du and dP/dv come from the differences over the quad, px = dP/du qx.u + dP/dv qx.v and
// likewise py. The rows of M^-1 are J along N and depth along the face, so that the numbers are
// those of frame-cot; what differs is that M does not exist where the UV map is degenerate: there K
// is 0, flagged.
//
// NOFRAME as frame-cot.
#pragma once

#include "quadrel/relief/frame/cot.hpp"

namespace quadrel {

/// Columns dP/du and dP/dv; null where the UV map is degenerate.
template <Number F>
UvDirections<F> surface_tangents(const vec3<F>& px, const vec3<F>& py, const vec2<F>& qx,
                                 const vec2<F>& qy, Mask<F> regular) {
    const F det = qx.x * qy.y - qx.y * qy.x;
    const vec3<F> zero(F(0));
    return {select(regular, (px * qy.y - py * qx.y) / det, zero),
            select(regular, (py * qx.x - px * qy.x) / det, zero)};
}

struct FrameInverseTbn : DerivativeFrame {
    static constexpr StageText text{
        "frame-inverse-tbn", "frame", "inverse of the matrix of tangents and normal",
        "correction of frame-inverse-tbn@published: tangents, not gradients"};

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const vec3<F> dPdx = io.template load<Value::dPdx>();
        const vec3<F> dPdy = io.template load<Value::dPdy>();
        const F scale = ordinary_scale(dPdx, dPdy);
        const vec3<F> px = dPdx * scale, py = dPdy * scale;
        const vec2<F> qx = io.template load<Value::dUVdx>(), qy = io.template load<Value::dUVdy>();
        SurfaceJacobian<F> j = gram_jacobian(px, py, qx, qy);
        const vec3<F> n = cross(px, py);
        j.valid = j.valid & (abs(dot(surface.N, n)) > degenerate_tolerance<F>() * length(n));
        const Mask<F> regular = j.valid & !j.uv_degenerate;
        const auto tangents = surface_tangents(px, py, qx, qy, regular);
        const mat3<F> to_texture = transpose(inverse(mat3<F>(tangents.T, tangents.B, surface.N)));
        const vec3<F> zero(F(0));
        j.grad_u = select(regular, to_texture[0] * scale, zero);
        j.grad_v = select(regular, to_texture[1] * scale, zero);
        const F r = select(regular, dot(to_texture[2], surface.V),
                           oblique_depth_rate(surface, io.template load<Value::Ng>()));
        store_frame(io, surface, j, r);
    }
};

}  // namespace quadrel
