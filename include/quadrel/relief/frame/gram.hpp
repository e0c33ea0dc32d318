// frame-gram: the exact derivative frame, orthogonal split.
//
// Corrects frame-thesis: the coordinates (a, b) of a vector in the basis (px, py) of window-space
// tangents solve the 2x2 Gram system instead of being plain dot products. In cross-product form,
//     n = px x py,  a = (w x py).n / n^2,  b = (px x w).n / n^2,  J w = qx a + qy b,
// which at grazing angles keeps the accuracy that the determinant of the Gram matrix loses.
// The split is orthogonal: a vector's depth is its component along the (interpolated) unit normal,
// its surface part the projection onto the face plane. Back faces use the flipped normal.
//
// NOFRAME when |n|^2 <= (8 eps)^2 |px|^2 |py|^2, or when the ray does not enter the surface (r <=
// 0). A UV map of rank 0 or 1 is no error: J is what it is, and the flag uv_degenerate says so.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

/// J as the rows grad u and grad v, in the plane of px and py; `valid` is false for NOFRAME.
template <Number F>
struct SurfaceJacobian {
    vec3<F> grad_u, grad_v;
    Mask<F> valid;
    Mask<F> uv_degenerate;
};

template <Number F>
SurfaceJacobian<F> gram_jacobian(const vec3<F>& px, const vec3<F>& py, const vec2<F>& qx,
                                 const vec2<F>& qy) {
    const vec3<F> n = cross(px, py);
    const F n2 = dot(n, n);
    const F tolerance = F(8) * F(std::numeric_limits<Scalar<F>>::epsilon());
    SurfaceJacobian<F> j;
    j.valid = n2 > tolerance * tolerance * (dot(px, px) * dot(py, py));
    // Dual basis: a = w . (py x n) / n^2, b = w . (n x px) / n^2.
    const vec3<F> dual_x = cross(py, n) / n2;
    const vec3<F> dual_y = cross(n, px) / n2;
    const vec3<F> zero(F(0));
    j.grad_u = select(j.valid, dual_x * qx.x + dual_y * qy.x, zero);
    j.grad_v = select(j.valid, dual_x * qx.y + dual_y * qy.y, zero);
    const F area = abs(qx.x * qy.y - qx.y * qy.x);
    j.uv_degenerate = area <= tolerance * (length(qx) * length(qy));
    return j;
}

/// Unit direction of growing u (and v) in the face plane: the dual basis of grad u, grad v. Null
/// where the UV map is degenerate.
template <Number F>
struct UvDirections {
    vec3<F> T, B;
};

template <Number F>
UvDirections<F> uv_directions(const SurfaceJacobian<F>& j) {
    const vec3<F> n = cross(j.grad_u, j.grad_v);
    const vec3<F> zero(F(0));
    const Mask<F> regular = j.valid & (dot(n, n) > F(0));
    return {select(regular, normalize(cross(j.grad_v, n)), zero),
            select(regular, normalize(cross(n, j.grad_u)), zero)};
}

struct FrameGram : StageDefaults {
    static constexpr StageText text{
        "frame-gram", "frame", "exact derivative frame, orthogonal split",
        "correction of frame-thesis by the Gram system of the tangents"};
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::dPdx, Value::dPdy, Value::dUVdx,
               Value::dUVdy, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> px = io.template load<Value::dPdx>();
        const vec3<F> py = io.template load<Value::dPdy>();
        const vec3<F> V = to_viewer(P, io.frame());
        const vec3<F> unflipped = normalize(io.template load<Value::vertex_normal>());
        const vec3<F> N =
            select(dot(io.template load<Value::Ng>(), V) < F(0), -unflipped, unflipped);
        const auto j = gram_jacobian(px, py, io.template load<Value::dUVdx>(),
                                     io.template load<Value::dUVdy>());
        const F r = dot(V, N);
        const Mask<F> valid = j.valid & (r > F(0));
        const vec3<F> d = -V;
        const vec2<F> shift(dot(j.grad_u, d), dot(j.grad_v, d));
        const vec2<F> rate = select(valid, shift / r, vec2<F>(F(0)));

        const auto directions = uv_directions(j);
        io.template store<Value::T>(directions.T);
        io.template store<Value::B>(directions.B);
        io.template store<Value::frame_normal>(N);
        io.template store<Value::J>(std::array<vec3<F>, 2>{j.grad_u, j.grad_v});
        io.template store<Value::r>(select(valid, r, F(1)));
        io.template store<Value::uv_rate>(rate);
        io.template store<Value::K>(rate * io.template load<Value::relief_depth>());
        io.template store<Value::frame_status>(
            select(valid, status_packet<F>(Status::hit), status_packet<F>(Status::no_frame)));
        io.template store<Value::frame_flags>(
            select(j.uv_degenerate, Int<F>(HitFlag::uv_degenerate), Int<F>(0)));
    }
};

}  // namespace quadrel
