// bump-noise@published: noise that modifies N.L, as published.
//
// Source: T. Renk, "Relief maps" (FlightGear wiki, 2016), "Bumpiness effect":
//     noisegrad = (Noise2D(Pos.xy, scale) - Noise2D(Pos.xy + (0.05 * scale) *
//                 normalize(lightDir.xy), scale)) / (0.05 * scale);
//     NdotL = NdotL + noisegrad * noise_magnitude;
// A shading normal is all that this room hands on: N + lightDir (noisegrad * noise_magnitude),
// whose dot product with lightDir, a unit vector, is that NdotL (for the first light, no other).
// Pos.xy, undisplaced, and lightDir.xy are taken in texture coordinates, by J, where the listing
// has those of a flat mesh; Noise2D(p, scale), which it leaves open, is an octave of gradient noise
// of p / scale, brought to [0, 1]. A light at a point is seen from Pos. Defects kept: a light
// overhead has lightDir.xy 0, whose normalisation is NaN; a one-sided difference; the normal is not
// of unit length. Not reproduced: Noise2D itself; N.L of any light but the first.
#pragma once

#include "quadrel/relief/noise.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {

struct BumpNoisePublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"bump-noise@published", "surface",
                                    "noise towards the first light, added to N.L",
                                    "Renk, Relief maps (FlightGear wiki, 2016), bumpiness effect"};
    static constexpr const char* not_reproduced =
        "Noise2D, which the listing does not show: an octave of gradient noise stands in its "
        "place; N.L of any light but the first";
    static constexpr auto inputs = values(Value::P, Value::uv, Value::frame_normal, Value::J);
    static constexpr auto outputs = surface_outputs;
    struct Params {
        float scale = 0.125f, magnitude = 0.05f;
    };
    static constexpr std::array parameters{
        parameter<&Params::scale>("scale", "tile", "length of the noise's cells", 1e-3, 1e3, 0.125),
        parameter<&Params::magnitude>("magnitude", "tile", "noise_magnitude of the listing", 0, 1e6,
                                      0.05)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> N = io.template load<Value::frame_normal>();
        if (io.frame().light_count == 0) return io.template store<Value::N>(N);
        const vec3<F> L = to_light(io.template load<Value::P>(), io.frame().lights[0]);
        const auto J = io.template load<Value::J>();
        const vec2<F> pos = io.template load<Value::uv>();
        const vec2<F> light_xy(dot(J[0], L), dot(J[1], L));
        const F scale(params.scale), step = F(0.05f) * scale;
        const F noisegrad =
            (noise_2d(pos, scale) - noise_2d(pos + normalize(light_xy) * step, scale)) / step;
        io.template store<Value::N>(N + L * (noisegrad * F(params.magnitude)));
    }

    /// Noise2D of the listing, in [0, 1].
    template <class F>
    static F noise_2d(const vec2<F>& pos, F scale) {
        return F(0.5f) + F(0.5f) * lattice_noise<F>(pos / scale, Scalar<F>(0), 0).value;
    }
};

}  // namespace quadrel
