// bump-blinn: Blinn's wrinkled surfaces from window-space differences, without a UV frame.
//
// Sources: J. Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978; M. Mikkelsen, "Bump Mapping
// Unparametrized Surfaces on the GPU", 2010:
//     R1 = py x N,  R2 = N x px,  det = px . R1,
//     n = normalize(|det| N - sign(det) (Hx R1 + Hy R2)),
// px, py the differences of the surface point, Hx, Hy those of the height D h. That is the normal
// of N - D grad h with gradients that N is orthogonal to.
// `differences` quad: those of the quad, one fetch a fragment: constant over it in each axis, seen
// as 2x2 blocks when magnified, and wrong where a search displaced neighbours differently.
// `differences` fetches: heights one pixel's step of the undisplaced UV away, three fetches.
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/relief/frame/store.hpp"
#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct BumpBlinn : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "bump-blinn", "surface", "normal from window-space height differences",
        "Blinn 1978; Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU (2010)"};
    static constexpr auto inputs =
        values(Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy, Value::relief_depth,
               Value::frame_normal, Value::frame_status, Value::hit_uv);
    struct Params {
        std::int32_t differences = 1;
    };
    static constexpr ValueName differences_names[] = {{0, "quad"}, {1, "fetches"}};
    static constexpr std::array parameters{choice<&Params::differences>(
        "differences", "of the quad's lanes, or of three fetches", differences_names, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const F depth = io.template load<Value::relief_depth>();
        const vec3<F> N = io.template load<Value::frame_normal>();
        const vec3<F> dPdx = io.template load<Value::dPdx>(),
                      dPdy = io.template load<Value::dPdy>();
        const F scale = ordinary_scale(dPdx, dPdy);
        const vec3<F> px = dPdx * scale;
        const vec3<F> R1 = cross(dPdy * scale, N), R2 = cross(N, px);
        const F det = dot(px, R1);
        const vec2<F> rise =
            (params.differences == 0 ? quad_rise<F>(io) : pixel_rise<F>(io)) * (depth * scale);
        const vec3<F> gradient = (R1 * rise.x + R2 * rise.y) * sign(det);
        const vec3<F> n = N * abs(det) - gradient;
        store_normal(io, normalize(n * ordinary_scale(largest_component(n))),
                     (depth != F(0)) & (det != F(0)));
    }

  private:
    template <class F, class Io>
    static vec2<F> quad_rise(Io& io) {
        const F h = march_heights(io)(io.active(), io.template load<Value::hit_uv>());
        return {dFdx(h, io.frame().derivatives), dFdy(h, io.frame().derivatives)};
    }

    template <class F, class Io>
    static vec2<F> pixel_rise(Io& io) {
        const auto heights = march_heights(io);
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const F h = heights(io.active(), uv);
        return {heights(io.active(), uv + io.template load<Value::dUVdx>()) - h,
                heights(io.active(), uv + io.template load<Value::dUVdy>()) - h};
    }
};

}  // namespace quadrel
