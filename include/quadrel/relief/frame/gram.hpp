// frame-gram: the exact derivative frame; orthogonal split unless `split` says oblique.
//
// Corrects frame-thesis: the coordinates (a, b) of a vector in the basis (px, py) of window-space
// tangents solve the 2x2 Gram system instead of being plain dot products. In cross-product form,
//     n = px x py,  a = (w x py).n / n^2,  b = (px x w).n / n^2,  J w = qx a + qy b,
// which at grazing angles keeps the accuracy that the determinant of the Gram matrix loses.
// A vector's depth is its component along the (interpolated) unit normal, its surface part the
// projection onto the face plane; split.hpp has the other way. Back faces use the flipped normal.
//
// NOFRAME when |n|^2 <= (8 eps)^2 |px|^2 |py|^2, or when the ray does not enter the surface (r <=
// 0). A UV map of rank 0 or 1 is no error: J is what it is, and the flag uv_degenerate says so.
#pragma once

#include "quadrel/relief/frame/split.hpp"

namespace quadrel {

template <Number F>
SurfaceJacobian<F> gram_jacobian(const vec3<F>& dPdx, const vec3<F>& dPdy, const vec2<F>& qx,
                                 const vec2<F>& qy) {
    const F scale = ordinary_scale(dPdx, dPdy);
    const vec3<F> px = dPdx * scale, py = dPdy * scale;
    const vec3<F> n = cross(px, py);
    const F n2 = dot(n, n);
    const F tolerance = degenerate_tolerance<F>();
    SurfaceJacobian<F> j;
    j.valid = n2 > tolerance * tolerance * (dot(px, px) * dot(py, py));
    // Dual basis: a = w . (py x n) / n^2, b = w . (n x px) / n^2.
    const vec3<F> dual_x = cross(py, n) / n2;
    const vec3<F> dual_y = cross(n, px) / n2;
    const vec3<F> zero(F(0));
    j.grad_u = select(j.valid, (dual_x * qx.x + dual_y * qy.x) * scale, zero);
    j.grad_v = select(j.valid, (dual_x * qx.y + dual_y * qy.y) * scale, zero);
    const F area = abs(qx.x * qy.y - qx.y * qy.x);
    j.uv_degenerate = area <= tolerance * (length(qx) * length(qy));
    return j;
}

struct FrameGram : DerivativeFrame {
    static constexpr StageText text{
        "frame-gram", "frame", "exact derivative frame, orthogonal split",
        "correction of frame-thesis by the Gram system of the tangents"};
    using Params = SplitParams;
    static constexpr auto parameters = split_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        store_split_frame(
            io,
            gram_jacobian(io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
                          io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>()),
            params);
    }
};

}  // namespace quadrel
