// prism-free: the ray bends with the surface's frame, step by step; rays that leave through the top
// are discarded.
//
// Source: Y.-C. Chen, C.-F. Chang, "A Prism-Free Method for Silhouette Rendering in Inverse
// Displacement Mapping", Pacific Graphics 2008, of which the abstract could be read: "at each step
// of intersection finding, we continuously bend the viewing ray according to the current local
// tangent space". How their steps do so is not known; here it is done as follows. Of the unit
// normal N the differences over the quad give N_u and N_v, which are taken to hold along the ray,
// and with M = J (N_u, N_v) a step of sigma (curved_path.hpp) at depth s is
//
//     z = (s_polygon - s) D,   rho = (I + z M)^-1 p,        UV rate at height z over the polygon
//     n = N_u rho.u + N_v rho.v,                            how the normal turns
//     e += n g,   g -= n . e,   p += J n g D,               the ray in the turned frame
//     uv += rho,  s += g
//
// times its length, all of it as half of such a step has left it (the midpoint rule); at the
// polygon p is K, g is 1 and e the ray's direction over r. Exact where the surface is flat, of
// second order in a step where its curvature is constant. As many steps as asked for lead to where
// the curve of second order would leave; twice as many are made, then the search ends as CAP.
// Relief above the polygon (seat) is climbed to by as many steps backwards, without look-ups. The
// bracket of the last step is halved as the straight piece that it is. What shades and shadows the
// hit is handed the frame that has turned by all n on the way.
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/relief/trace/curved/quadric_path.hpp"

namespace quadrel {

/// How the unit normal turns a unit of u and v, on the frame's side of the surface; null where the
/// quad has no area in texture space.
template <Number F>
struct NormalTurn {
    vec3<F> along_u, along_v;
};

template <class Io, class F = typename Io::Number>
NormalTurn<F> normal_turn(const Io& io) {
    const vec3<F> n = io.template load<Value::vertex_normal>();
    const vec2<F> x = io.template load<Value::dUVdx>(), y = io.template load<Value::dUVdy>();
    const auto mode = io.frame().derivatives;
    const vec3<F> dx = dFdx(n, mode), dy = dFdy(n, mode);
    const F area = x.x * y.y - x.y * y.x, size = length(n);
    const vec3<F> unit = n / size;
    const F side = select(dot(io.template load<Value::frame_normal>(), n) < F(0), F(-1), F(1));
    const Mask<F> regular = abs(area) > F(0);
    const auto turn = [&](const vec3<F>& along) {
        const vec3<F> within = along - unit * dot(unit, along);
        return select(regular, within * (side / (area * size)), vec3<F>(F(0)));
    };
    return {turn(dx * y.y - dy * x.y), turn(dy * x.x - dx * y.x)};
}

/// The bending ray; see above.
template <Number F>
class BentRay {
  public:
    template <class Io>
    BentRay(const Io& io, const SearchRay<F>& ray)
        : here{ray.uv, F(ray.s_polygon), F(0)},
          turn_(normal_turn(io)),
          J_(io.template load<Value::J>()),
          p_(ray.K),
          depth_(ray.depth),
          s_polygon_(ray.s_polygon) {
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        e_ = -V / io.template load<Value::r>();
        bend_ = F(0.5f) * dot(turned(p_), e_);
    }

    PathPoint<F> here;
    vec3<F> turn = vec3<F>(F(0));  ///< of the normal since the fragment, as an angle

    /// Of second order where it begins: s = s_polygon + sigma - bend sigma^2.
    F bend() const { return bend_; }
    /// Whether it goes up.
    Mask<F> rises() const { return g_ < F(0); }

    /// A step of `length` in the lanes of `mask`; where the surface's normals meet, nothing that it
    /// leads to is a number: there the ray stays.
    void advance(Mask<F> mask, F length) {
        const F half = length * F(0.5f);
        const vec3<F> n_half = turned(rate(p_, here.s)) * half;
        const vec3<F> e_half = e_ + n_half * g_;
        const vec2<F> p_half = p_ + across(n_half) * (g_ * depth_);
        const F g_half = g_ - dot(n_half, e_);
        const vec2<F> rho = rate(p_half, here.s + g_ * half);
        const vec3<F> n = turned(rho) * length;
        const vec3<F> e = e_ + n * g_half;
        const vec2<F> p = p_ + across(n) * (g_half * depth_);
        const F g = g_ - dot(n, e_half);
        const vec2<F> uv = here.uv + rho * length;
        const F s = here.s + g_half * length;
        const vec3<F> turned_by = turn + n;
        mask =
            mask & is_finite(dot(turned_by, turned_by) + dot(e, e) + dot(p, p) + dot(uv, uv) + s);
        here.uv = select(mask, uv, here.uv);
        here.s = select(mask, s, here.s);
        here.sigma = select(mask, here.sigma + length, here.sigma);
        turn = select(mask, turned_by, turn);
        e_ = select(mask, e, e_);
        p_ = select(mask, p, p_);
        g_ = select(mask, g, g_);
    }

    /// The unit normal of the fragment, turned by an angle: 2 atan(|angle| / 2), for the angle.
    static vec3<F> turned_normal(const vec3<F>& N, const vec3<F>& angle) {
        const vec3<F> half = angle * F(0.5f);
        const F square = dot(half, half);
        return (N * (F(1) - square) + angle) / (F(1) + square);
    }
    /// J at depth s, in the directions of the fragment; the fragment's where normals meet.
    std::array<vec3<F>, 2> J_at(F s) const {
        std::array<vec3<F>, 2> J;
        for (int c = 0; c < 3; ++c) {
            const vec2<F> column = rate(vec2<F>(J_[0][c], J_[1][c]), s);
            const Mask<F> known = is_finite(column.x + column.y);
            J[0][c] = select(known, column.x, J_[0][c]);
            J[1][c] = select(known, column.y, J_[1][c]);
        }
        return J;
    }

  private:
    vec3<F> turned(const vec2<F>& rho) const {
        return turn_.along_u * rho.x + turn_.along_v * rho.y;
    }
    vec2<F> across(const vec3<F>& v) const { return {dot(J_[0], v), dot(J_[1], v)}; }
    /// rho of p at depth s, by Cramer's rule.
    vec2<F> rate(const vec2<F>& p, F s) const {
        const F z = (F(s_polygon_) - s) * depth_;
        const vec2<F> u = across(turn_.along_u) * z, v = across(turn_.along_v) * z;
        const F a = F(1) + u.x, d = F(1) + v.y, determinant = a * d - v.x * u.y;
        return vec2<F>(d * p.x - v.x * p.y, a * p.y - u.y * p.x) / determinant;
    }

    NormalTurn<F> turn_;
    std::array<vec3<F>, 2> J_;
    vec3<F> e_;
    vec2<F> p_;
    F g_ = F(1), depth_, bend_;
    Scalar<F> s_polygon_;
};

struct PrismFree : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"prism-free", "trace",
                                    "linear search along a ray that bends with the frame",
                                    "Chen and Chang 2008"};
    static constexpr auto inputs =
        search_inputs_and(Value::P, Value::r, Value::T, Value::B, Value::J, Value::frame_normal,
                          Value::vertex_normal);
    static constexpr auto outputs = curved_outputs;
    struct Params {
        std::int32_t steps = 64, binary_steps = 6;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps to about where a ray leaves", 1,
                                  most_steps / 2, 64),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         6)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        BentRay<F> path(io, ray);
        const QuadricPath<F> way(ray, path.bend());
        const F n = number<F>(params.steps);
        for (const auto k : steps<F>(1, params.steps)) {
            const Mask<F> climbs = ray.active & (path.here.s > F(0));
            if (none(climbs)) break;
            path.advance(climbs, way.first / n);
        }
        const F length = (way.last - way.first) / n;
        PathBracket<F> bracket;
        bracket.above = F(0);
        bracket.below = F(1);
        PathPoint<F> before = path.here;
        vec3<F> turn_before = path.turn;
        Mask<F> active = ray.active, left(false);
        for (const auto k : steps<F>(0, 2 * params.steps)) {
            // Up, or thrown up by a step over where normals meet, behind which it goes anywhere.
            const Mask<F> upwards = path.rises() | (path.here.s < before.s);
            left = left | (active & upwards & (path.here.s <= F(0)));
            active = active & !left;
            const F s = path.here.s, h = height(active, s, path.here.uv, F(1) - s);
            const Mask<F> under = bracket.narrow(active, F(1), s, h);
            bracket.h = select(active, h, bracket.h);
            bracket.found = bracket.found | under;
            active = active & !under;
            if (none(active)) break;
            before.uv = select(active, path.here.uv, before.uv);
            before.s = select(active, s, before.s);
            before.sigma = select(active, path.here.sigma, before.sigma);
            turn_before = select(active, path.turn, turn_before);
            path.advance(active, length);
        }
        bracket.above = F(0);
        const auto piece = [&](F part) {
            const F rest = F(1) - part;
            return PathPoint<F>{before.uv * rest + path.here.uv * part,
                                before.s * rest + path.here.s * part,
                                before.sigma * rest + path.here.sigma * part};
        };
        halve(height, piece, params.binary_steps, bracket);
        const Int<F> otherwise =
            select(left, status_packet<F>(Status::clip), status_packet<F>(Status::cap));
        const Int<F> status = select(bracket.found, status_packet<F>(Status::hit), otherwise);
        const F part = bracket.below;
        const PathPoint<F> end = piece(part);
        store_path(io, with_passing_rays(io, ray), bracket, end,
                   select(bracket.met_nan, status_packet<F>(Status::nan), status));
        const vec3<F> turn = turn_before * (F(1) - part) + path.turn * part;
        const vec3<F> N = io.template load<Value::frame_normal>();
        store_turned_frame(io, ray, BentRay<F>::turned_normal(N, turn), path.J_at(end.s));
    }
};

}  // namespace quadrel
