// What all searches of a height field share: the ray, its results, and how they are handed on.
//
//     height 1 = top, s = depth below the top plane in units of the relief's depth D,
//     uv(s) = uv + (s - s_polygon) K, the hit is the smallest s in [0, 1] with
//     height(uv(s)) >= 1 - s.
#pragma once

#include "quadrel/relief/heights.hpp"

namespace quadrel {

/// What a search loads. Rows that read more list it after these (search_inputs_and).
inline constexpr auto search_inputs =
    values(Value::uv, Value::dUVdx, Value::dUVdy, Value::relief_depth, Value::K,
           Value::frame_status, Value::frame_flags);

template <class... V>
constexpr auto search_inputs_and(V... more) {
    return values_and(search_inputs, more...);
}

/// What searches load that read level 0, whatever the footprint.
inline constexpr auto level_0_search_inputs =
    values(Value::uv, Value::relief_depth, Value::K, Value::frame_status, Value::frame_flags);

/// The view ray of every lane in texture space.
template <Number F>
struct SearchRay {
    vec2<F> uv;           ///< undisplaced
    vec2<F> K;            ///< UV shift from s = 0 to s = 1
    F depth;              ///< D, world units
    Scalar<F> s_polygon;  ///< where the polygon lies: 1 - seat
    Mask<F> active;       ///< lanes that search: active, with a frame
    Int<F> frame_status, frame_flags;

    vec2<F> at(F s) const { return uv + K * (s - F(s_polygon)); }
    vec2<F> at(Scalar<F> s) const { return uv + K * F(s - s_polygon); }
};

template <class Io, class F = typename Io::Number>
SearchRay<F> search_ray(const Io& io) {
    SearchRay<F> ray;
    ray.uv = io.template load<Value::uv>();
    ray.K = io.template load<Value::K>();
    ray.depth = io.template load<Value::relief_depth>();
    ray.s_polygon = Scalar<F>(1) - Scalar<F>(io.material().seat);
    ray.frame_status = io.template load<Value::frame_status>();
    ray.frame_flags = io.template load<Value::frame_flags>();
    ray.active = io.active() & (ray.frame_status == status_packet<F>(Status::hit));
    return ray;
}

/// What a search found, lane by lane. Initially: nothing, at the bottom plane.
template <Number F>
struct SearchResult {
    F s = F(1);
    F h = F(0);  ///< height that ended the search
    Int<F> status = status_packet<F>(Status::floor);
    Int<F> flags = Int<F>(0);    ///< to be added to the frame's
    Int<F> steps = Int<F>(0);    ///< points of the ray that were tested
    Int<F> fetches = Int<F>(0);  ///< texture look-ups of any kind
};

/// HIT where found; NAN where a height that the search compared was NaN; else `otherwise`.
template <Number F>
Int<F> search_status(Mask<F> found, Mask<F> met_nan, Status otherwise = Status::floor) {
    return select(met_nan, status_packet<F>(Status::nan),
                  select(found, status_packet<F>(Status::hit), status_packet<F>(otherwise)));
}

/// Stores a search's outputs. Lanes without a frame stay on the polygon with the frame's status.
/// `uv`: the displaced coordinates; by default those of s on the ray. `depth`: hit_depth, where s
/// does not say it.
template <class Io, class F = typename Io::Number>
void store_search(const Io& io, const SearchRay<F>& ray, const SearchResult<F>& found,
                  const vec2<F>& uv, F depth) {
    const Mask<F> framed = ray.frame_status == status_packet<F>(Status::hit);
    const F s = select(framed, found.s, F(ray.s_polygon));
    const Mask<F> starts_below = (found.status == status_packet<F>(Status::hit)) &
                                 Mask<F>(found.s == F(0)) & (found.h > F(1));
    const Int<F> flags =
        found.flags | select(starts_below, Int<F>(HitFlag::start_below), Int<F>(0));
    io.template store<Value::hit_uv>(select(framed, uv, ray.uv));
    io.template store<Value::hit_s>(s);
    io.template store<Value::hit_h>(found.h);
    io.template store<Value::hit_depth>(select(framed, depth, F(0)));
    io.template store<Value::hit_status>(select(framed, found.status, ray.frame_status));
    const Int<F> all = flags | nan_look_up_flag(uv);
    io.template store<Value::hit_flags>(ray.frame_flags | select(framed, all, Int<F>(0)));
    io.template store<Value::hit_steps>(found.steps);
    io.template store<Value::hit_fetches>(found.fetches);
}
template <class Io, class F = typename Io::Number>
void store_search(const Io& io, const SearchRay<F>& ray, const SearchResult<F>& found,
                  const vec2<F>& uv) {
    store_search(io, ray, found, uv, (found.s - F(ray.s_polygon)) * ray.depth);
}
template <class Io, class F = typename Io::Number>
void store_search(const Io& io, const SearchRay<F>& ray, const SearchResult<F>& found) {
    store_search(io, ray, found, ray.at(found.s));
}

}  // namespace quadrel
