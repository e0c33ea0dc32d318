// A ray through a tetrahedron of a shell: from where it enters, the fragment, to where it leaves,
// linear in texture space.
//
//     uv(t) = uv + t (uv_out - uv),  s(t) = s + t (s_out - s),  t in [0, 1],
//     the hit is the smallest t with height(uv(t)) >= 1 - s(t).
#pragma once

#include "quadrel/relief/shell/shell_face.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// A search through a piece of a shell, where rays may leave without a hit.
struct PrismTrace : StageDefaults {
    static constexpr auto inputs =
        values(Value::P, Value::dPdx, Value::dPdy, Value::uv, Value::uv_rate, Value::relief_depth,
               Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr bool may_miss = true;
    static constexpr bool reads_vertices = true;
};

template <Number F>
struct PrismRay {
    F length;         ///< world units from where it enters to where it leaves, >= 0
    F s, s_shift;     ///< depth below the shell's top where it enters, and how much more at the end
    SearchRay<F> uv;  ///< its K is the shift over the whole length, s_polygon 0
    Mask<F> ends_below;  ///< where it leaves is at or below any height: the shell's bottom

    F s_at(F t) const { return s + s_shift * t; }
    F height_at(F t) const { return (F(1) - s) - s_shift * t; }
};

/// Where a ray that is inside of a tetrahedron leaves it.
template <Number F>
struct PrismExit {
    F length;
    Mask<F> to_floor;
};

/// By the faces that the ray comes nearer to: those opposite of the face's own corners. A ray that
/// comes nearer to none of them has length 0.
///
/// Corners are snapped to the window's lattice, so that the rays of two faces at a pixel are up to
/// one of its places apart, and coverage may give a pixel to one side of a face while the ray runs
/// along its other side. So a ray goes on for as long as it is within such a distance of a face, in
/// the texture space of its tetrahedron: neighbours overlap there, and leave nothing between them.
/// `px`, `py`: window-space differences of the point where it enters. Not at the shell's bottom,
/// where every ray has hit.
template <Number F>
PrismExit<F> prism_exit(const ShellFaces<F>& face, const vec3<F>& d, const vec3<F>& px,
                        const vec3<F>& py) {
    const F never(std::numeric_limits<Scalar<F>>::infinity()), floor = face.to_floor();
    PrismExit<F> exit{never, Mask<F>(false)};
    for (int k = 0; k < 3; ++k) {
        const vec3<F> gradient = face.gradient(k);
        const Mask<F> to_floor = floor == F(Scalar<F>(k));
        const F near = (abs(dot(gradient, px)) + abs(dot(gradient, py))) * face.snap();
        const F rate = dot(gradient, d);
        const F weight = max(face.weight(k), F(0)) + select(to_floor, F(0), near);
        const F length = select(rate < F(0), weight / -rate, never);
        const Mask<F> first = length < exit.length;
        exit.length = select(first, length, exit.length);
        exit.to_floor = (exit.to_floor & !first) | (first & to_floor);
    }
    exit.length = select(exit.length < never, exit.length, F(0));
    return exit;
}

/// A ray that enters at `s`, without an end yet.
template <class Io, class F = typename Io::Number>
PrismRay<F> prism_ray_from(const Io& io, F s) {
    PrismRay<F> ray;
    ray.s = s;
    ray.uv.uv = io.template load<Value::uv>();
    ray.uv.depth = io.template load<Value::relief_depth>();
    ray.uv.s_polygon = 0;
    ray.uv.frame_status = io.template load<Value::frame_status>();
    ray.uv.frame_flags = io.template load<Value::frame_flags>();
    ray.uv.active = io.active() & (ray.uv.frame_status == status_packet<F>(Status::hit));
    return ray;
}

template <class Io, class F = typename Io::Number>
PrismRay<F> prism_ray(const Io& io) {
    const ShellFaces<F> face(io);
    const vec3<F> d = -to_viewer(io.template load<Value::P>(), io.frame());
    const PrismExit<F> exit =
        prism_exit(face, d, io.template load<Value::dPdx>(), io.template load<Value::dPdy>());
    PrismRay<F> ray = prism_ray_from(io, clamp(face.s(), F(0), F(1)));
    ray.length = exit.length;
    const F shift = dot(face.s_gradient(), d) * ray.length;
    ray.s_shift = select(exit.to_floor, F(1) - ray.s, shift);
    ray.uv.K = io.template load<Value::uv_rate>() * ray.length;
    // Of depth 0 the shell is the mesh, and met at once.
    ray.ends_below = exit.to_floor | !(ray.uv.depth > F(0));
    return ray;
}

/// Stores what was found; `found.s` is t. Rays without a hit are CLIP, at the end of their piece.
template <class Io, class F = typename Io::Number>
void store_prism(const Io& io, const PrismRay<F>& ray, const SearchResult<F>& found) {
    const Mask<F> framed = ray.uv.frame_status == status_packet<F>(Status::hit);
    const F t = select(framed, found.s, F(0));
    const vec2<F> uv = ray.uv.at(t);
    const vec2<F>& from = ray.uv.uv;
    const Mask<F> meets = found.status == status_packet<F>(Status::hit);
    const Mask<F> wrapped = (floor(uv.x) != floor(from.x)) | (floor(uv.y) != floor(from.y));
    const Mask<F> starts_below = meets & (t == F(0)) & (found.h > ray.height_at(F(0)));
    const Int<F> unset(0);
    const Int<F> flags = found.flags | select(starts_below, Int<F>(HitFlag::start_below), unset) |
                         select(wrapped & meets, Int<F>(HitFlag::wrapped), unset) |
                         nan_look_up_flag(uv);
    io.template store<Value::hit_uv>(select(framed, uv, from));
    io.template store<Value::hit_s>(clamp(ray.s_at(t), F(0), F(1)));
    io.template store<Value::hit_h>(found.h);
    io.template store<Value::hit_depth>(ray.length * t);
    io.template store<Value::hit_status>(select(framed, found.status, ray.uv.frame_status));
    io.template store<Value::hit_flags>(ray.uv.frame_flags | select(framed, flags, unset));
    io.template store<Value::hit_steps>(found.steps);
    io.template store<Value::hit_fetches>(found.fetches);
}

}  // namespace quadrel
