// A view ray in the coordinates of a curved relief, and its search by halving.
//
// Over a curved surface a straight ray is none in texture space: seen from the surface it comes
// down more and more slowly, and may leave through the top again. Where it is, is said by sigma,
// how far a ray over the fragment's own plane would be below the polygon, in units of the relief's
// depth D: a point of the world, P + d sigma D / r, wherever the surface has gone meanwhile. s is
// the depth below the curved top plane there.
#pragma once

#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

/// A point of the ray.
template <Number F>
struct PathPoint {
    vec2<F> uv;
    F s;
    F sigma;
};

/// Neighbouring samples of a path, of which the second is at or below the surface, as parameters of
/// the path.
template <Number F>
struct PathBracket {
    F above = F(0), below = F(0);
    F h = F(0);  ///< height at `below`; before one is found, the height tested last
    Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);
    Int<F> steps = Int<F>(0);

    /// Takes in the height h at `at`, which is of depth s; the lanes of `active` at or below it.
    Mask<F> narrow(Mask<F> active, F at, F s, F height) {
        const Mask<F> under = active & (height >= F(1) - s);
        below = select(under, at, below);
        h = select(under, height, h);
        above = select(active & !under, at, above);
        met_nan = met_nan | (active & is_nan(height));
        count_in<F>(steps, active);
        return under;
    }
};

/// Halves the bracket `times` times, where one was found. `path(at)` is a PathPoint.
template <Number F, class Height, class Path>
void halve(const Height& height, const Path& path, int times, PathBracket<F>& bracket) {
    for (const auto k : steps<F>(1, times)) {
        const F middle = (bracket.above + bracket.below) * F(0.5f);
        const PathPoint<F> point = path(middle);
        const F h = height(bracket.found, point.s, point.uv, F(1) - point.s);
        bracket.narrow(bracket.found, middle, point.s, h);
    }
}

/// What these searches store: the frame is that of the hit from then on.
inline constexpr auto curved_outputs =
    values_and(trace_outputs, Value::frame_normal, Value::T, Value::B, Value::J);

/// The rotation of a unit vector to another one, which leaves what is perpendicular to both; of
/// opposite ones, to which any half turn leads, the reflection.
template <Number F>
class Turn {
  public:
    Turn(const vec3<F>& from, const vec3<F>& to) : from_(from), to_(to), sum_(from + to) {
        const F length = F(1) + dot(from, to);
        scale_ = select(length > F(0), F(1) / length, F(0));
    }

    vec3<F> operator()(const vec3<F>& v) const {
        return v - sum_ * (dot(sum_, v) * scale_) + to_ * (F(2) * dot(from_, v));
    }

  private:
    vec3<F> from_, to_, sum_;
    F scale_;
};

/// Stores the frame where the unit normal has become `normal` and J, in the directions of the
/// fragment, `J`: what shades and shadows the hit reads it. It stays as it is, bit for bit, where
/// nothing turns and where there is none.
template <class Io, class F = typename Io::Number>
void store_turned_frame(const Io& io, const SearchRay<F>& ray, const vec3<F>& normal,
                        const std::array<vec3<F>, 2>& J) {
    const vec3<F> N = io.template load<Value::frame_normal>();
    const vec3<F> T = io.template load<Value::T>(), B = io.template load<Value::B>();
    const auto own = io.template load<Value::J>();
    const vec3<F> change = normal - N;
    const Mask<F> framed = ray.frame_status == status_packet<F>(Status::hit);
    const Mask<F> turns = framed & (dot(change, change) > F(0));
    const Turn<F> turn(N, normal);
    io.template store<Value::frame_normal>(select(turns, normal, N));
    io.template store<Value::T>(select(turns, turn(T), T));
    io.template store<Value::B>(select(turns, turn(B), B));
    io.template store<Value::J>(std::array<vec3<F>, 2>{select(turns, turn(J[0]), own[0]),
                                                       select(turns, turn(J[1]), own[1])});
}

/// Where the facet is seen and the normal is turned away, the fragment lies outside of the curved
/// surface's outline: its ray comes in nowhere and is a miss, not one without a frame, which would
/// be drawn as it is.
template <class Io, class F = typename Io::Number>
SearchRay<F> with_passing_rays(const Io& io, const SearchRay<F>& ray) {
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    const Mask<F> passes = (ray.frame_status == status_packet<F>(Status::no_frame)) &
                           (dot(io.template load<Value::frame_normal>(), V) <= F(0));
    SearchRay<F> changed = ray;
    changed.frame_status = select(passes, status_packet<F>(Status::clip), ray.frame_status);
    return changed;
}

/// Stores where a search has ended.
template <class Io, class F = typename Io::Number>
void store_path(const Io& io, const SearchRay<F>& ray, const PathBracket<F>& bracket,
                const PathPoint<F>& end, Int<F> status) {
    SearchResult<F> result;
    result.s = clamp(end.s, F(0), F(1));
    result.h = bracket.h;
    result.status = status;
    result.steps = result.fetches = bracket.steps;
    store_search(io, ray, result, end.uv, end.sigma * ray.depth);
}

}  // namespace quadrel
