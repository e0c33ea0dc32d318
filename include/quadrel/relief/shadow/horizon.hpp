// horizon: the light's elevation against the horizon in its direction.
//
// Source: N. Max, "Horizon mapping: shadows for bump-mapped surfaces", The Visual Computer 4, 1988;
// P.-P. Sloan, M. Cohen, "Interactive Horizon Mapping", EGWR 2000. The tangent of the horizon is
// interpolated between the two stored azimuths beside the light's, and between texels. With
// `softness` 0 the light is a point; else it fades over that range of the tangent.
// Exact towards stored azimuths from texel centres; between them a spire may be passed over, or
// shade what it does not.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

/// Tangent of the horizon, heights and tiles being of one length, towards a direction in tiles.
template <class Io, class F = typename Io::Number>
F horizon_tangent(const Io& io, Mask<F> active, const vec2<F>& uv, const vec2<F>& direction) {
    const BakedLookUp<TextureSlot::horizon, 1, Io> read(io);
    const std::int32_t azimuths = io.template texture<TextureSlot::horizon>()->view.faces;
    const F count(static_cast<Scalar<F>>(azimuths));
    const F turn = atan2(direction.y, direction.x) * F(0.15915494309189535f);  // / 2 pi
    const F at = (turn - floor(turn)) * count, below = floor(at);
    const auto wrapped = [&](F k) { return to_int(select(k >= count, k - count, k)); };
    return lerp(read(active, uv, wrapped(below)).channel[0],
                read(active, uv, wrapped(below + F(1))).channel[0], at - below);
}

struct Horizon : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"horizon", "shadow", "the light against a horizon map",
                                    "Max 1988; Sloan and Cohen 2000"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::horizon);
    struct Params {
        float softness = 0;
    };
    static constexpr std::array parameters{parameter<&Params::softness>(
        "softness", "1", "range of the tangent over which the light fades, relative to it", 0, 10,
        0)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const LightRay<F> ray = light_ray(io);
        const F kappa = length(ray.K);
        const Mask<F> asks = ray.active & (kappa > F(0));
        const F horizon = horizon_tangent(io, asks, ray.uv, ray.K);
        // The light's own tangent is 1 / kappa.
        const F excess = F(1) - horizon * kappa;
        const F soft = clamp(excess / F(params.softness) + F(0.5f), F(0), F(1));
        const F hard = select(excess >= F(0), F(1), F(0));
        const F visibility = params.softness > 0 ? soft : hard;
        store_shadow(io, ray, select(asks, visibility, F(1)), select(asks, Int<F>(1), Int<F>(0)));
    }
};

}  // namespace quadrel
