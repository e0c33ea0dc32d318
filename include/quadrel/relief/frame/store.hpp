// What every frame ends with: the view ray over the surface, and its outputs.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

/// J as the rows grad u and grad v, in a plane of the frame's; `valid` is false for NOFRAME.
template <Number F>
struct SurfaceJacobian {
    vec3<F> grad_u, grad_v;
    Mask<F> valid;
    Mask<F> uv_degenerate;
};

/// Differences from which nothing is left but rounding: 8 ulp.
template <Number F>
F degenerate_tolerance() {
    return F(8) * F(std::numeric_limits<Scalar<F>>::epsilon());
}

template <Number F>
F largest_component(const vec3<F>& v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// The power of two that brings a size to between 1 and 2: with vectors so scaled, products of four
/// of them neither overflow nor vanish, in worlds of 1e-18 units as of 1e18. All else keeps its
/// bits, since the scaling is exact.
template <Number F>
F ordinary_scale(F size) {
    constexpr int most = std::numeric_limits<Scalar<F>>::max_exponent - 2;
    return power_of_two(clamp(-exponent(size), F(Scalar<F>(-most)), F(Scalar<F>(most))));
}
template <Number F>
F ordinary_scale(const vec3<F>& a, const vec3<F>& b) {
    return ordinary_scale(max(largest_component(a), largest_component(b)));
}

/// length(v), also where the squares are beyond what F holds.
template <Number F>
F length_at_any_scale(const vec3<F>& v) {
    const F scale = ordinary_scale(largest_component(v));
    return length(v * scale) / scale;
}

/// Whether the gradients of u and v are parallel, or one of them is null.
template <Number F>
Mask<F> gradients_degenerate(const vec3<F>& grad_u, const vec3<F>& grad_v) {
    const F scale = ordinary_scale(grad_u, grad_v);
    const vec3<F> u = grad_u * scale, v = grad_v * scale;
    return length(cross(u, v)) <= degenerate_tolerance<F>() * (length(u) * length(v));
}

/// Unit direction of growing u (and v) in the frame's plane: the dual basis of grad u, grad v. Null
/// where the UV map is degenerate.
template <Number F>
struct UvDirections {
    vec3<F> T, B;
};

template <Number F>
UvDirections<F> uv_directions(const SurfaceJacobian<F>& j) {
    const F scale = ordinary_scale(j.grad_u, j.grad_v);
    const vec3<F> u = j.grad_u * scale, v = j.grad_v * scale;
    const vec3<F> n = cross(u, v), to_u = cross(v, n), to_v = cross(n, u);
    const vec3<F> zero(F(0));
    const Mask<F> regular = j.valid & (dot(to_u, to_u) > F(0)) & (dot(to_v, to_v) > F(0));
    return {select(regular, normalize(to_u), zero), select(regular, normalize(to_v), zero)};
}

/// The unit vector to the eye, and the unit vertex normal on the viewer's side of the face.
template <Number F>
struct ViewedSurface {
    vec3<F> V, N;
};

template <class Io, class F = typename Io::Number>
ViewedSurface<F> viewed_surface(const Io& io) {
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    const vec3<F> unflipped = normalize(io.template load<Value::vertex_normal>());
    return {V, select(dot(io.template load<Value::Ng>(), V) < F(0), -unflipped, unflipped)};
}

/// Stores a frame: K = D / r * J d. NOFRAME where J is not valid or r <= 0 (the ray does not enter
/// the surface); there K is 0, and r 1 because displacement divides by it.
template <class Io, class F = typename Io::Number>
void store_frame(const Io& io, const ViewedSurface<F>& surface, const SurfaceJacobian<F>& j,
                 const UvDirections<F>& directions, F r) {
    const Mask<F> valid = j.valid & (r > F(0));
    const vec3<F> d = -surface.V;
    const vec2<F> shift(dot(j.grad_u, d), dot(j.grad_v, d));
    const vec2<F> rate = select(valid, shift / r, vec2<F>(F(0)));
    io.template store<Value::T>(directions.T);
    io.template store<Value::B>(directions.B);
    io.template store<Value::frame_normal>(surface.N);
    io.template store<Value::J>(std::array<vec3<F>, 2>{j.grad_u, j.grad_v});
    io.template store<Value::r>(select(valid, r, F(1)));
    io.template store<Value::uv_rate>(rate);
    io.template store<Value::K>(rate * io.template load<Value::relief_depth>());
    io.template store<Value::frame_status>(
        select(valid, status_packet<F>(Status::hit), status_packet<F>(Status::no_frame)));
    io.template store<Value::frame_flags>(
        select(j.uv_degenerate, Int<F>(HitFlag::uv_degenerate), Int<F>(0)));
}

/// The same with unit directions of growing u and v as tangents.
template <class Io, class F = typename Io::Number>
void store_frame(const Io& io, const ViewedSurface<F>& surface, const SurfaceJacobian<F>& j, F r) {
    store_frame(io, surface, j, uv_directions(j), r);
}

}  // namespace quadrel
