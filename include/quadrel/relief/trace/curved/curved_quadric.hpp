// curved-quadric: relief mapping over quadrics that are fitted to the mesh: rays that leave through
// the curved top are discarded, which gives the mesh an outline of relief.
//
// Source: M. M. Oliveira, F. Policarpo, "An Efficient Representation for Surface Details", UFRGS
// RP-351, 2005, of which the abstract could be read, and the shader of F. Policarpo that goes with
// it in two adaptations (D. Skillman's for 3ds Max, 2007, and one for Unity: ray_position,
// ray_intersect_rm_curved). Below a surface that falls away by a x^2 + b y^2 along the vertices'
// tangents (scene/quadrics.hpp), interpolated, a ray is at depth
//
//     s = s_polygon + sigma - c sigma^2,   c = (a x^2 + b y^2) D / r^2 of its direction (x, y),
//
// and its UV moves as if the surface were flat. Steps are equal ones between where it comes in and
// where it leaves, at the bottom or at the top. Differs from the shader: bisection keeps the
// bracket that the linear search has found, planes at both ends are tested, nothing is added to the
// way or to c (0.001 there), the frame is the material's, and relief above the polygon (seat) is
// searched from where the same curve comes in. With quadrics of 0, bit for bit relief-binary at
// seat 1. Second order in the curvature alone: UV lags behind. What shades and shadows the hit is
// handed the frame turned to the quadric's normal there; the shader has the fragment's.
#pragma once

#include "quadrel/relief/trace/curved/quadric_path.hpp"

namespace quadrel {

/// A fragment's quadric along its ray. On the back of a mesh what was convex is hollow.
template <Number F>
struct TangentQuadric {
    F bend;         ///< c; 0 where the fragment has no tangent
    vec3<F> slope;  ///< how the normal leans a unit of sigma, before it is made unit again
    vec3<F> N;

    template <class Io>
    explicit TangentQuadric(const Io& io) : N(io.template load<Value::frame_normal>()) {
        const vec3<F> d = -to_viewer(io.template load<Value::P>(), io.frame());
        const vec3<F> T = io.template load<Value::T>(), across = cross(N, T);
        const F outside = dot(N, io.template load<Value::vertex_normal>());
        const F side = select(outside < F(0), F(-1), F(1));
        const vec2<F> quadric = io.template load<Value::quadric>() * side;
        // World units a unit of sigma.
        const F way = io.template load<Value::relief_depth>() / io.template load<Value::r>();
        const F x = dot(d, T), y = dot(d, across);
        bend = (quadric.x * x * x + quadric.y * y * y) * way / io.template load<Value::r>();
        slope = (T * (quadric.x * x) + across * (quadric.y * y)) * (F(2) * way);
    }

    vec3<F> normal_at(F sigma) const {
        const vec3<F> lean = slope * sigma;
        return select(dot(lean, lean) > F(0), normalize(N + lean), N);
    }
};

struct CurvedQuadric : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"curved-quadric", "trace",
                                    "linear search and bisection over fitted quadrics",
                                    "Oliveira and Policarpo 2005"};
    static constexpr auto inputs =
        search_inputs_and(Value::P, Value::r, Value::T, Value::B, Value::J, Value::frame_normal,
                          Value::vertex_normal, Value::quadric);
    static constexpr auto outputs = curved_outputs;
    struct Params {
        std::int32_t steps = 64, binary_steps = 6;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>(
            "steps", "1", "steps from where a ray comes in to where it leaves", 1, most_steps, 64),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         6)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const TangentQuadric<F> quadric(io);
        const QuadricPath<F> path(search_ray(io), quadric.bend);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F n = number<F>(params.steps);
        PathBracket<F> bracket;
        bracket.above = bracket.below = path.first;
        Mask<F> active = path.ray.active;
        for (const auto k : steps<F>(0, params.steps)) {
            // The last sample of a path that leaves at the top is on it.
            active = active & (path.descends | (number<F>(k) < n));
            if (none(active)) break;
            const F part = number<F>(k) / n;
            const F sigma = path.first * (F(1) - part) + path.last * part;
            const PathPoint<F> point = path(sigma);
            const F h = height(active, point.s, point.uv, F(1) - point.s);
            const Mask<F> under = bracket.narrow(active, sigma, point.s, h);
            bracket.h = select(active, h, bracket.h);
            bracket.found = bracket.found | under;
            active = active & !under;
        }
        halve(height, path, params.binary_steps, bracket);
        const PathPoint<F> end = path(select(bracket.found, bracket.below, path.last));
        const Int<F> otherwise =
            select(path.descends, status_packet<F>(Status::floor), status_packet<F>(Status::clip));
        const Int<F> status = select(bracket.found, status_packet<F>(Status::hit), otherwise);
        store_path(io, with_passing_rays(io, path.ray), bracket, end,
                   select(bracket.met_nan, status_packet<F>(Status::nan), status));
        store_turned_frame(io, path.ray, quadric.normal_at(end.sigma),
                           io.template load<Value::J>());
    }
};

}  // namespace quadrel
